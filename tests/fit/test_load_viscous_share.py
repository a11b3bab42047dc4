"""The part of the viscous friction behind a shaft is fitted: it is no constant (the trials draw it)."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

import rwn
from rwn.model.model import Model
from rwn.studies.trials.effects.torque import EFFECTS

# A motor whose viscous friction counts, with a load that swings at 28 Hz.
MOTOR = {"resistance": 1.1, "inductance": 4e-4, "torque_constant": 0.037, "back_emf_constant": 0.037,
         "inertia": 2.8e-5, "viscous_friction": 4e-4}  # fmt: skip
SHAFT = {"stiffness": 0.2, "damping": 1e-5, "load_inertia": 1.1e-5}


@pytest.mark.parametrize("share", [0.1, 0.8])
def test_a_fit_that_begins_elsewhere_finds_it(share: float) -> None:
    rng = np.random.default_rng(5)
    time = 1e-3 * np.arange(3000)
    voltage = 4.0 * np.repeat(rng.uniform(-1.0, 1.0, 150), 20)
    true = Model(kind="dc", parameters=MOTOR, effects={"shaft-compliance": {**SHAFT, "load_viscous_share": share}})
    seen = rwn.simulate(true, rwn.Recording(name="a", time=time, signals={"voltage": voltage})).signals
    noisy = {s: seen[s] + 1e-3 * np.std(seen[s]) * rng.standard_normal(time.size) for s in ("current", "speed")}
    known = "shaft-compliance.load_viscous_share"
    begun = Model(
        kind="dc", parameters=MOTOR, effects={"shaft-compliance": {**SHAFT, "load_viscous_share": 0.4}},
        uncertainty={known: 1.0},
    )  # fmt: skip
    found = rwn.identify(rwn.Recording(name="a", time=time, signals={"voltage": voltage, **noisy}), begun)
    low, high = found.parameters[known].interval or (np.nan, np.nan)
    assert low < share < high
    assert high - low < 0.3


def test_the_trials_draw_it() -> None:
    motor = SimpleNamespace(inertia=2.8e-5, time_constant=0.05)
    situation = SimpleNamespace(motor=motor, rate=1000.0, speed=100.0)
    shafts = [e for e in EFFECTS if "load_viscous_share" in e.units]
    assert {e.name for e in shafts} == {"shaft-compliance", "backlash"}
    for effect in shafts:
        rng = np.random.default_rng(1)
        drawn = [effect.draw(rng, situation)["load_viscous_share"] for _ in range(20)]  # type: ignore[arg-type]
        assert min(drawn) < 0.2 < 0.7 < max(drawn)
