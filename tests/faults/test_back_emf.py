"""The back-EMF of a winding says how fast its shaft turns, whatever else is wrong."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from made_up_motor import MOTOR
from rwn.faults.back_emf import BackEmf, back_emf
from rwn.faults.scale import wrong_scale

MODEL = rwn.Model(kind="dc", parameters=MOTOR, uncertainty={"inertia": 0.1, "resistance": 0.05})


def _recording(*, factor: float = 1.0, lost: str = "", rising: bool = False) -> rwn.Recording:
    rng, time = np.random.default_rng(2), 1e-3 * np.arange(3000)
    voltage = 6.0 * np.sign(np.sin(7.0 * time)) + 3.0 * np.sin(2.0 * time)
    voltage = 4.0 * time + 0.1 * voltage if rising else voltage
    given = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    friction = {"coulomb-friction": {"coulomb_torque": 0.05}, "quadratic-drag": {"drag_coefficient": 1e-5}}
    out = rwn.simulate(replace(MODEL, effects=friction), given).signals
    noisy = {s: out[s] + 0.01 * out[s].std() * rng.standard_normal(time.size) for s in ("current", "speed")}
    noisy["speed"] = factor * noisy["speed"]
    signals = {"voltage": voltage, **{s: x for s, x in noisy.items() if s != lost}}
    return rwn.Recording(name="run", time=time, signals=signals)


@pytest.mark.parametrize("factor", [1.0, 9.549, 0.1, -1.0, 25.0])
def test_it_is_measured_beside_friction_that_the_model_lacks(factor: float) -> None:
    found = back_emf([_recording(factor=factor)], MODEL)
    assert found.ratio == pytest.approx(1.0 / factor, rel=0.03)
    assert found.deviation < 0.02 * abs(found.ratio)
    assert not found.denies(factor)
    assert BackEmf(ratio=1.0, deviation=0.01).denies(factor) is (factor != 1.0)


@pytest.mark.parametrize("lost", ["current", "speed"])
def test_without_current_or_speed_nothing_is_denied(lost: str) -> None:
    found = back_emf([_recording(lost=lost)], MODEL)
    assert not any(found.denies(factor) for factor in (-1.0, 9.549, 1e-3))


def test_nothing_is_denied_where_nothing_turns_or_there_is_no_winding() -> None:
    still = _recording()
    still = replace(still, signals={**still.signals, "speed": np.zeros(len(still))})
    assert not back_emf([still], MODEL).denies(9.549)
    axis = rwn.Model(kind="axis", parameters={"inertia": 1e-3, "viscous_friction": 1e-3})
    turning = rwn.Recording(name="run", time=still.time, signals={"torque": np.sin(still.time), "speed": still.time})
    assert not back_emf([turning], axis).denies(9.549)


@pytest.mark.parametrize("times", [100.0, 300.0, 1000.0])
def test_an_inertia_that_is_wrong_by_far_is_no_gear_and_no_unit(times: float) -> None:
    """The motor as given hardly turns, and the recorded speed is large beside it: but as large as the winding says."""
    heavy = replace(MODEL, parameters={**MOTOR, "inertia": times * MOTOR["inertia"]})
    assert wrong_scale([_recording(rising=True)], heavy) is None
    fault = wrong_scale([_recording(factor=9.549, rising=True)], MODEL)
    assert fault is not None
    assert fault.signals == ("speed",)
