"""What Python writes of a drive's linear equations, for first guesses, is what the core simulates."""

from __future__ import annotations

import numpy as np
import pytest

import rwn
from rwn.model.drives.dc import DC
from rwn.model.model import Model
from rwn.simulate.linear_response import speed_filter
from rwn.simulate.simulator import Simulator
from rwn.simulate.unknown_inputs import along_motion

MECHANICS = {"inertia": 4e-5, "viscous_friction": 2e-5}
WINDING = {"resistance": 6.0, "inductance": 0.0, "torque_constant": 0.05, "back_emf_constant": 0.05}
MODELS = [Model(kind="axis", parameters=MECHANICS), Model(kind="dc", parameters={**WINDING, **MECHANICS})]
LOAD, STEP = 2e-3, 1e-3  # N m, s


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.kind)
def test_the_speed_answers_a_torque_as_simulated(model: Model) -> None:
    loaded = Model(kind=model.kind, parameters=model.parameters, effects={"constant-load": {"torque": -LOAD}})
    signals = {model.drive.input: np.zeros(300)}
    run = rwn.Recording(name="load.csv", time=STEP * np.arange(300), signals=signals)
    seen = rwn.simulate(loaded, run).signals["speed"]
    a, b = speed_filter(model.drive, model.vector, STEP)
    expected = b * LOAD * (1.0 - a ** np.arange(300)) / (1.0 - a)
    # a winding of 0 H is simulated with a transient, if a short one
    np.testing.assert_allclose(seen, expected, rtol=1e-3, atol=1e-6 * expected[-1])


def test_a_current_that_was_not_recorded_is_the_one_at_rest_with_the_speed() -> None:
    (_, model) = MODELS
    rng = np.random.default_rng(1)
    speed, voltage = rng.uniform(-100.0, 100.0, (2, 50))
    resting = DC.resting_current(WINDING, speed, voltage)
    torques = [
        along_motion(
            Simulator.of(model), model.vector, [], time=STEP * np.arange(50.0), driven=voltage, position=np.zeros(50),
            speed=speed, acceleration=np.zeros(50), current=current,
        )[0]
        for current in (np.empty(0), resting)
    ]  # fmt: skip
    np.testing.assert_allclose(*torques, rtol=1e-12)
