"""Further lines of a cogging torque are read off what the first leaves, and stay its own."""

from __future__ import annotations

import numpy as np
import pytest

import rwn
from made_up_motor import MOTOR, plant
from rwn.fit.fit import Fit, fit_nominal
from rwn.fit.preparation import prepare
from rwn.fit.problem import Problem
from rwn.fit.residuals import statistics
from rwn.model.model import Model
from rwn.name.further_lines import with_further_lines
from rwn.name.screening import screen

STEP = 1e-3
SLOTS, POLES = (0.03, 12.0, 0.7), (0.012, 14.0, -1.1)  # amplitude [N m], periods per revolution, phase


def _fitted(*lines: tuple[float, float, float]) -> tuple[Problem, Fit]:
    """A motor with such a cogging torque, by a plant that is not the core's, and its explanation by one line."""
    rng = np.random.default_rng(3)
    voltage = np.repeat(rng.uniform(-6.0, 6.0, 30), 100)
    seen = plant(voltage, lambda _, angle: -sum(a * np.sin(n * angle + p) for a, n, p in lines), step=STEP)
    noisy = seen + 0.003 * np.std(seen, axis=0) * rng.standard_normal(seen.shape)
    signals = {"voltage": voltage, "current": noisy[:, 0], "speed": noisy[:, 1], "position": seen[:, 2]}
    run = rwn.Recording(name="run", time=STEP * np.arange(voltage.size), signals=signals)
    problem = prepare([run], Model(kind="dc", parameters=MOTOR, uncertainty={"inertia": 0.1}))
    return problem, screen(problem, fit_nominal(problem), ["cogging-torque"])[0]


def test_poles_beside_slots_are_a_second_line() -> None:
    problem, one = _fitted(SLOTS, POLES)
    (found,) = with_further_lines(problem, [one])
    assert found.added == one.added == ("cogging-torque",)
    assert found.periods == pytest.approx([12.0, 14.0], abs=0.01)
    values = found.values_of("cogging-torque")
    assert set(values) == {
        "amplitude", "periods_per_rev", "phase", "amplitude_2", "periods_per_rev_2", "phase_2"
    }  # fmt: skip
    assert [values["amplitude_2"], values["phase_2"]] == pytest.approx([POLES[0], POLES[2]], rel=0.05)
    assert found.cost < 0.1 * one.cost


def test_poles_and_slots_may_differ_by_one() -> None:
    """Such as 8 poles and 9 slots, with what both have in common."""
    problem, one = _fitted((0.004, 9.0, 0.7), (0.003, 8.0, -1.9), (0.005, 72.0, 2.3))
    (found,) = with_further_lines(problem, [one])
    assert sorted(found.periods) == pytest.approx([8.0, 9.0, 72.0], abs=0.02)
    assert statistics(problem, found).at_the_floor


def test_noise_is_no_line() -> None:
    problem, one = _fitted(SLOTS)
    assert with_further_lines(problem, [one]) == [one]
    assert one.periods == pytest.approx([12.0], abs=0.01)
