"""A torque that comes back once per turn of a shaft behind a gear."""

from __future__ import annotations

import numpy as np
import pytest

import rwn
from made_up_motor import MOTOR, plant
from rwn.fit.nominal import nominal_of
from rwn.name.initial_guesses import spectra
from rwn.name.observable import observable

RATIO, AMPLITUDE = 19.2, 0.02
SURE = {"resistance": 0.05, "inertia": 0.08, "viscous_friction": 0.4}
MODEL = rwn.Model(kind="dc", parameters=MOTOR, uncertainty=SURE)


def turning(seed: int, *, size: float = 1.0, amplitude: float = AMPLITUDE, rows: int = 6000) -> rwn.Recording:
    """Steps of the voltage, under which the slow shaft makes three turns or four."""
    rng = np.random.default_rng(seed)
    levels = size * rng.uniform(0.0, 12.0, rows // 300)
    voltage = np.repeat(np.round(levels, 3), 300)
    seen = plant(voltage, lambda _, angle: -amplitude * np.sin(angle / RATIO + 0.8))
    signals = {"voltage": voltage, "current": seen[:, 0], "speed": seen[:, 1]}
    noisy = {s: v + (s != "voltage") * 5e-3 * np.std(v) * rng.standard_normal(rows) for s, v in signals.items()}
    return rwn.Recording(name=f"turning_{seed}.csv", time=1e-3 * np.arange(rows, dtype=np.float64), signals=noisy)


def test_its_order_is_the_highest_line_over_the_angle() -> None:
    problem, nominal = nominal_of([turning(1), turning(2)], MODEL)
    effect = problem.prior.table["geared-unbalance"]
    assert observable("geared-unbalance", problem)
    first = spectra.slow_orders(problem, nominal, effect, 3)[0]
    travel = max(float(np.ptp(r.angle)) for r in problem.runs) / (2.0 * np.pi)
    assert first == pytest.approx(1.0 / RATIO, abs=0.5 / travel)


def test_what_comes_once_need_not_come_back() -> None:
    """Two periods of the fastest shaft that is looked for are more than two revolutions of the motor."""
    short, nominal = nominal_of([turning(1, size=0.02, rows=600)], MODEL)
    assert not observable("geared-unbalance", short)
    assert spectra.slow_orders(short, nominal, short.prior.table["geared-unbalance"], 3) == []


def test_lines_that_stand_out_are_told_apart_by_the_steps_of_the_grid() -> None:
    power = np.random.default_rng(1).exponential(size=200)
    power[[10, 100, 130]] = 50.0, 200.0, 150.0
    orders = 0.02 + 0.004 * np.arange(200)
    assert spectra.standing_out(power, orders, 5) == orders[[100, 130, 10]].tolist()
    assert spectra.standing_out(power[:1], orders[:1], 5) == []


def test_what_noise_leaves_has_no_line() -> None:
    plain = [turning(k, amplitude=0.0) for k in (1, 2, 3, 4)]
    problem, nominal = nominal_of(plain, MODEL)
    assert spectra.slow_orders(problem, nominal, problem.prior.table["geared-unbalance"], 3) == []


@pytest.mark.slow
def test_it_is_named_with_the_ratio_of_the_gear_and_corrects() -> None:
    found = rwn.diagnose([turning(1), turning(2)], MODEL, heldout=[turning(3)])
    assert [e.name for e in found.effects] == ["geared-unbalance"]
    numbers = found.effects[0].parameters
    assert numbers["periods_per_rev"].value == pytest.approx(1.0 / RATIO, rel=1e-2)
    assert numbers["amplitude"].value == pytest.approx(AMPLITUDE, rel=0.05)
    (speed,) = (row for row in found.heldout if row.signal == "speed" and row.region == "all")
    assert speed.noise_floor is not None
    assert speed.refitted is not None
    assert speed.corrected < 1.1 * speed.noise_floor < 0.5 * speed.refitted


@pytest.mark.slow
def test_a_motor_without_one_is_not_given_one() -> None:
    found = rwn.diagnose([turning(4, amplitude=0.0), turning(5, amplitude=0.0)], MODEL)
    assert found.verdict == "adequate"
