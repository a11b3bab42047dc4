"""The input where no row shows it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from rwn.fit.intersample import stating
from rwn.fit.unrecorded_input import with_unrecorded_input
from rwn.model.model import Model

MOTOR = {"resistance": 1.0, "inductance": 1e-3, "torque_constant": 0.05, "back_emf_constant": 0.05, "inertia": 2e-5,
         "viscous_friction": 2e-5}  # fmt: skip
MODEL = Model(kind="dc", parameters=MOTOR, uncertainty={"inertia": 0.1, "viscous_friction": 0.1})


@pytest.mark.parametrize("friction", [0.0, 5e-3])
def test_the_motion_tells_when_a_voltage_stepped_between_two_rows(friction: float) -> None:
    rng, time = np.random.default_rng(4), 1e-3 * np.arange(6000)
    ends = np.cumsum(rng.integers(40, 60, 160))
    voltage = rng.uniform(-3.0, 3.0, 160)[np.searchsorted(ends, np.arange(6000), side="right")]
    truth = Model(kind="dc", parameters=MOTOR, effects={"coulomb-friction": {"coulomb_torque": friction}})
    bare = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    speed = rwn.simulate(truth, bare).signals["speed"] + 0.05 * rng.standard_normal(time.size)
    kept = replace(bare, time=time[::2], signals={"voltage": voltage[::2], "speed": speed[::2]})
    (found,) = with_unrecorded_input([kept], stating(MODEL, "halves"))
    assert found.applied_input is not None
    unknown = found.applied_input.spread > 0.3
    true = voltage[np.rint(found.applied_input.instants[unknown] / 1e-3).astype(int)]
    between = np.interp(found.applied_input.instants[unknown], kept.time, voltage[::2])
    assert np.std(found.applied_input.values[unknown] - true) < 0.3 * np.std(between - true)


def test_a_held_input_is_known_from_its_rows() -> None:
    signals = {"voltage": np.ones(100), "speed": np.ones(100)}
    run = rwn.Recording(name="run", time=1e-3 * np.arange(100.0), signals=signals)
    assert with_unrecorded_input([run], stating(MODEL, "held")) == [run]
