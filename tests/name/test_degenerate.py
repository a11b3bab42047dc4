"""Explanations that a plainer one says as well."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

import rwn
from ranked import ranked_from
from rwn.fit.fit import Fit
from rwn.fit.problem import Problem
from rwn.model.model import Model
from rwn.name.degenerate import adds
from rwn.name.observable import revolutions

FitWith = Callable[[str], Fit]  # an effect's name -> the demo's recording explained by it


@pytest.mark.parametrize(("begin", "end", "none"), [(0.3, 0.6, False), (0.0005, 0.9995, True), (0.998, 0.9985, True)])
def test_a_load_from_end_to_end_or_for_a_moment_is_none(
    problem: Problem, fit_with: FitWith, begin: float, end: float, none: bool
) -> None:
    this = fit_with("load-disturbance")
    names = [u.name for u in this.hypothesis.unknowns]
    at = [names.index(f"load-disturbance.{t}") for t in ("t_start", "t_end")]
    values = this.minimum.values.copy()
    values[at] = np.array([begin, end]) * this.hypothesis.unknowns[at[0]].upper
    moved = replace(this, minimum=replace(this.minimum, values=values))
    assert moved.windows == [pytest.approx((begin, end))]
    assert adds(moved, problem) != none
    assert fit_with("quadratic-drag").windows == []


@pytest.mark.parametrize(("travelled", "none"), [(1.2, False), (0.8, True)])
def test_what_is_periodic_has_a_period_that_is_travelled(
    problem: Problem, fit_with: FitWith, travelled: float, none: bool
) -> None:
    this = fit_with("cogging-torque")
    names = [u.name for u in this.hypothesis.unknowns]
    values = this.minimum.values.copy()
    values[names.index("cogging-torque.periods_per_rev")] = travelled / revolutions(problem)
    moved = replace(this, minimum=replace(this.minimum, values=values))
    assert revolutions(problem) * moved.periods[0] == pytest.approx(travelled)
    assert adds(moved, problem) != none
    assert fit_with("quadratic-drag").periods == []


@pytest.mark.parametrize(("turns", "none"), [(0.5, False), (2.0, True)])
def test_a_shaft_that_is_wound_up_by_turns_is_none(
    problem: Problem, fit_with: FitWith, turns: float, none: bool
) -> None:
    this = fit_with("shaft-compliance")
    names = [u.name for u in this.hypothesis.unknowns]
    values = this.minimum.values.copy()
    behind = values[names.index("shaft-compliance.load_inertia")] / problem.scales["inertia"]
    assert behind < 0.5
    stiffness = behind * problem.scales["torque"] / (2.0 * np.pi * turns)  # of what moves the inertia behind it
    values[names.index("shaft-compliance.stiffness")] = stiffness
    assert adds(replace(this, minimum=replace(this.minimum, values=values)), problem) != none


def test_loads_that_say_the_same_do_not_keep_another_law_from_being_built_on() -> None:
    """A load at all times, one on a spring of no stiffness, one from end to end: all three are a constant load."""
    motor = {"resistance": 1.0, "inductance": 1e-3, "torque_constant": 0.05, "back_emf_constant": 0.05,
             "inertia": 2e-5, "viscous_friction": 2e-5, "coulomb_friction": 4e-3}  # fmt: skip
    truth = {"asymmetric-friction": {"coulomb_torque_plus": 5e-4, "coulomb_torque_minus": 6e-3},
             "quadratic-drag": {"drag_coefficient": 4e-7}}  # fmt: skip
    time = 1e-3 * np.arange(3000)
    voltage = 5.0 * np.sin(2 * np.pi * (1.0 * time + 1.0 * time**2))
    bare = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    speed = rwn.simulate(Model(kind="dc", parameters=motor, effects=truth), bare).signals["speed"]
    speed = speed + 0.1 * np.random.default_rng(2).standard_normal(time.size)
    run = rwn.Recording(name="run", time=time, signals={"voltage": voltage, "speed": speed})
    model = Model(kind="dc", parameters=motor, uncertainty={"coulomb_friction": 0.5, "viscous_friction": 0.5})
    loads = ["load-disturbance", "constant-load", "load-spring"]
    names = [*loads, "asymmetric-friction", "quadratic-drag"]
    ranking = ranked_from([run], model, names)
    alone = [f for f in ranking.alone.fits if f.added[0] in loads]
    assert sum(adds(f, ranking.problem) for f in alone) < 3
    assert {"asymmetric-friction", "quadratic-drag"} in [set(f.added) for f in ranking.fits]
