"""A position in free run adds up every small torque that is missing: what is new in its error is its last step."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from rwn.fit.fit import fit_nominal
from rwn.fit.preparation import prepare
from rwn.fit.residual_noise import noise_of, without_drift
from rwn.model.model import Model
from rwn.recording.noise import STABLE

AXIS = {"inertia": 9e-4, "viscous_friction": 1.2e-3, "coulomb_friction": 0.05}
COUNT = 2.0 * np.pi / 20_000
SHEET = Model(
    kind="axis", parameters={"inertia": 8e-4, "viscous_friction": 1e-3, "coulomb_friction": 0.055},
    uncertainty={"inertia": 0.1, "viscous_friction": 0.3, "coulomb_friction": 0.2},
)  # fmt: skip


def _recording(wandering: float, seed: int) -> rwn.Recording:
    """The axis under a torque that is recorded, and one beside it that wanders and is not."""
    rng = np.random.default_rng(seed)
    time = 1e-3 * np.arange(6000)
    torque = 0.25 * np.sign(np.sin(5.0 * time + 0.2)) + 0.1 * np.repeat(rng.uniform(-1.0, 1.0, 60), 100)
    unseen = wandering * np.cumsum(rng.standard_normal(time.size)) / np.sqrt(time.size)
    acted = rwn.Recording(name="acted", time=time, signals={"torque": torque + unseen})
    made = rwn.simulate(Model(kind="axis", parameters=AXIS), acted).signals
    speed = made["speed"] + 0.1 * rng.standard_normal(time.size)
    position = COUNT * np.round(made["position"] / COUNT)
    return rwn.Recording(name="run", time=time, signals={"torque": torque, "speed": speed, "position": position})


@pytest.mark.parametrize("wandering", [0.0, 1e-3])
def test_the_error_of_a_position_is_a_random_walk_where_it_drifts(wandering: float) -> None:
    problem = prepare([_recording(wandering, 1)], SHEET)
    weighted = without_drift(problem, fit_nominal(problem))
    assert (weighted is not None) == bool(wandering)
    if weighted is not None:
        assert weighted.noise["position"].reflection == (STABLE,)


def test_a_wandering_torque_bends_no_parameter() -> None:
    """The drift is thousands of counts: it would be followed by whatever parameter can, as friction by a half."""
    off, plainly = [], []
    for seed in range(6):
        run = _recording(1e-3, seed)
        found = rwn.identify(run, SHEET).parameters
        off.append([found[name].value / AXIS[name] - 1.0 for name in AXIS])
        problem = prepare([run], SHEET)
        this = fit_nominal(problem)
        problem = replace(problem, noise=noise_of(problem.runs, problem.residuals(this.vector, this.active)))
        plain = fit_nominal(problem)
        plainly.append([plain.value(name) / AXIS[name] - 1.0 for name in AXIS])
    rms, bent = (np.sqrt(np.mean(np.square(x), axis=0)) for x in (off, plainly))
    assert rms[0] < 0.005
    assert rms[2] < 0.06
    assert bent[0] > 0.01
    assert bent[2] > 0.2
