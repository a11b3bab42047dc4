"""What a start leaves once the unknowns that are there answer to first order."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from rwn.fit.fit import Fit, fit_nominal
from rwn.fit.hypothesis import Hypothesis, hypothesis
from rwn.fit.preparation import prepare
from rwn.fit.problem import Problem
from rwn.model.model import Model
from rwn.name.first_order import ALIKE, FirstOrder, FirstOrderCost

MOTOR = {
    "resistance": 1.0, "inductance": 1e-3, "torque_constant": 0.05, "back_emf_constant": 0.05, "inertia": 5e-5,
    "viscous_friction": 2e-5,
}  # fmt: skip
DRAG = {"quadratic-drag": {"drag_coefficient": 4e-7}}


@pytest.fixture(scope="module")
def dragged() -> Problem:
    """A motor with a drag, under its own model without it."""
    rng = np.random.default_rng(4)
    voltage = np.repeat(rng.uniform(-10.0, 10.0, 20), 100)
    run = rwn.Recording(name="x", time=1e-3 * np.arange(voltage.size), signals={"voltage": voltage})
    speed = rwn.simulate(Model(kind="dc", parameters=MOTOR, effects=DRAG), run).signals["speed"]
    signals = {"voltage": voltage, "speed": speed + 0.1 * rng.standard_normal(voltage.size)}
    uncertainty = {"inertia": 0.2, "viscous_friction": 0.5, "resistance": 0.1}
    sheet = Model(kind="dc", parameters=MOTOR, uncertainty=uncertainty)
    return prepare([replace(run, signals=signals)], sheet)


@pytest.fixture(scope="module")
def nominal(dragged: Problem) -> Fit:
    return fit_nominal(dragged)


def _start(problem: Problem, name: str, **guess: float) -> Hypothesis:
    return hypothesis(problem.prior, (name,), problem.scales, {name: guess})


def _nothing(dragged: Problem, nominal: Fit) -> FirstOrderCost:
    return FirstOrder(dragged, nominal).left_by(nominal.hypothesis.starting_at(nominal.minimum.values))


def _steps(share: float) -> float:
    return float(np.log(share) / np.log(ALIKE))


def test_the_law_that_is_missing_leaves_little_at_any_strength(dragged: Problem, nominal: Fit) -> None:
    order, nothing = FirstOrder(dragged, nominal), _nothing(dragged, nominal)
    strengths = [f * DRAG["quadratic-drag"]["drag_coefficient"] for f in (0.5, 1.0, 2.0)]
    left = [order.left_by(_start(dragged, "quadratic-drag", drag_coefficient=s)) for s in strengths]
    assert max(one.steps for one in left) < nothing.steps + _steps(0.05)
    assert left[1].error < min(left[0].error, left[2].error)
    other = order.left_by(_start(dragged, "unbalance", amplitude=2e-3, phase=0.0))
    assert other.steps > nothing.steps + _steps(0.5)


def test_what_the_nominal_parameters_can_do_explains_nothing(dragged: Problem, nominal: Fit) -> None:
    nothing = _nothing(dragged, nominal)
    moved = nominal.minimum.values * np.array([1.0 + 1e-3 * k for k in range(nominal.minimum.values.size)])
    left = FirstOrder(dragged, nominal).left_by(nominal.hypothesis.starting_at(moved))
    assert abs(left.steps - nothing.steps) <= 1.0


def test_a_start_that_runs_away_is_the_worst(dragged: Problem, nominal: Fit) -> None:
    start = _start(dragged, "quadratic-drag", drag_coefficient=1e-7)
    wild = start.start.copy()
    wild[start.by.index(dragged.prior.table["quadratic-drag"].at("drag_coefficient"))] = -1.0  # drives instead
    assert FirstOrder(dragged, nominal).left_by(start.starting_at(wild)) == (np.inf, np.inf)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_what_may_act_either_way_is_not_judged_by_the_sign_of_its_guess(sign: float) -> None:
    time = 1e-3 * np.arange(2000)
    signals = {"voltage": np.where(time < 1.0, 5.0, 8.0)}
    load = Model(kind="dc", parameters=MOTOR, effects={"constant-load": {"torque": sign * 2e-3}})
    speed = rwn.simulate(load, rwn.Recording(name="x", time=time, signals=signals)).signals["speed"]
    noisy = speed + 0.1 * np.random.default_rng(3).standard_normal(time.size)
    run = rwn.Recording(name="x", time=time, signals={**signals, "speed": noisy})
    problem = prepare([run], Model(kind="dc", parameters=MOTOR))
    order = FirstOrder(problem, fit_nominal(problem))
    right, wrong = (order.left_by(_start(problem, "constant-load", torque=t * sign * 1e-3)).steps for t in (1.0, -1.0))
    assert wrong == pytest.approx(right, abs=1.0)
    assert right < _nothing(problem, fit_nominal(problem)).steps + _steps(0.05)
