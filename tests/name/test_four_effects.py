"""Three effects of a drive are named beside one of how its sensor shows it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from made_up_motor import SMALL as MOTOR
from ranked import ranked_from
from rwn.model.model import Model

EFFECTS = {
    "coulomb-friction": {"coulomb_torque": 0.01},
    "quadratic-drag": {"drag_coefficient": 3e-7},
    "unbalance": {"amplitude": 0.006, "phase": 2.0},
    "speed-sensor-lag": {"time_constant": 0.003},
}


@pytest.mark.slow
def test_three_effects_and_a_lag_are_found() -> None:
    time = 1e-3 * np.arange(4000)
    voltage = 8.0 * np.sin(2 * np.pi * 0.7 * time) + 4.0 * np.sign(np.sin(2 * np.pi * 2.1 * time))
    run = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    seen = rwn.simulate(Model(kind="dc", parameters=MOTOR, effects=EFFECTS), run).signals
    rng = np.random.default_rng(3)
    noisy = {s: seen[s] + 0.01 * np.std(seen[s]) * rng.standard_normal(time.size) for s in ("current", "speed")}
    recorded = replace(run, signals={"voltage": voltage, **noisy, "position": seen["position"]})
    known_to = {"viscous_friction": 0.3, "inertia": 0.1, "resistance": 0.05}
    sheet = Model(kind="dc", parameters=MOTOR, uncertainty=known_to)
    names = [*EFFECTS, "constant-load", "load-disturbance"]
    best = ranked_from([recorded], sheet, names).fits[0].fit
    assert set(best.added) == set(EFFECTS)
    for name, values in EFFECTS.items():
        assert best.values_of(name) == pytest.approx(values, rel=0.1), name
