"""Fits where a contact makes the error non-smooth."""

from __future__ import annotations

import numpy as np
import pytest

import rwn
from rwn.fit.fit import fit
from rwn.fit.hypothesis import Hypothesis, hypothesis
from rwn.fit.intervals import IDEALISED, estimates
from rwn.fit.preparation import prepare
from rwn.fit.problem import Problem
from rwn.fit.residuals import Statistics
from rwn.fit.secant import down_secants, nonsmooth_unknowns
from rwn.model.model import Model

MOTOR = {"resistance": 1.1, "inductance": 4e-4, "torque_constant": 0.037, "back_emf_constant": 0.037,
         "inertia": 2.8e-5, "viscous_friction": 4e-6}  # fmt: skip
PLAY = {"gap": 0.02, "load_inertia": 1e-5, "contact_rate": 950.0, "contact_damping_ratio": 0.25,
        "load_viscous_share": 0.3}


@pytest.fixture(scope="module")
def problem() -> Problem:
    rng = np.random.default_rng(11)
    time = 5e-4 * np.arange(3000)
    true = Model(kind="dc", parameters=MOTOR, effects={"backlash": PLAY})
    voltage = 4.0 * np.repeat(rng.uniform(-1.0, 1.0, 60), 50)
    seen = rwn.simulate(true, rwn.Recording(name="play.csv", time=time, signals={"voltage": voltage})).signals
    noisy = {s: seen[s] + 0.01 * np.std(seen[s]) * rng.standard_normal(time.size) for s in ("current", "speed")}
    recording = rwn.Recording(name="play.csv", time=time, signals={"voltage": voltage, **noisy})
    return prepare([recording], Model(kind="dc", parameters=MOTOR))


def _hypothesis(problem: Problem, name: str, values: dict[str, float]) -> Hypothesis:
    return hypothesis(problem.prior, (name,), problem.scales, {name: values})


def test_turns_without_derivatives_reach_what_derivatives_do_not(problem: Problem) -> None:
    this = _hypothesis(problem, "backlash", {**PLAY, "gap": 0.15, "contact_rate": 3000.0})
    stopped = fit(problem, this)
    found = down_secants(problem, stopped, turns=3)
    k = [u.name for u in this.unknowns].index("backlash.gap")
    assert stopped.minimum.values[k] != pytest.approx(PLAY["gap"], rel=0.05)
    assert found.minimum.values[k] == pytest.approx(PLAY["gap"], rel=0.01)
    assert found.cost < stopped.cost


def test_derivatives_find_a_gap_from_three_times_its_size(problem: Problem) -> None:
    this = _hypothesis(problem, "backlash", {**PLAY, "gap": 0.06, "contact_rate": 1500.0})
    found = fit(problem, this).vector
    for unknown in this.unknowns:
        # of so little viscous friction it hardly shows where it is
        if unknown.name.startswith("backlash.") and not unknown.name.endswith("load_viscous_share"):
            assert found[unknown.index] == pytest.approx(PLAY[unknown.name.removeprefix("backlash.")], rel=0.01)


def test_a_smooth_error_is_left_to_derivatives(problem: Problem) -> None:
    this = _hypothesis(problem, "coulomb-friction", {"coulomb_torque": 1e-3})
    assert nonsmooth_unknowns(this) == []
    stopped = fit(problem, this)
    assert down_secants(problem, stopped, turns=3).minimum is stopped.minimum


def test_a_turn_never_loses(problem: Problem) -> None:
    this = _hypothesis(problem, "backlash", PLAY)
    best = fit(problem, this, max_iterations=0)
    assert down_secants(problem, best, turns=1).cost <= best.cost


def test_no_interval_of_a_contact_is_narrower_than_the_contact_is_exact(problem: Problem) -> None:
    this = _hypothesis(problem, "backlash", PLAY)
    white = Statistics(count=problem.samples, variance=1.0, correlation_time=1.0)
    found = estimates(fit(problem, this), white)
    gap = found["backlash.gap"]
    assert gap.interval is not None
    assert gap.interval[0] < PLAY["gap"] < gap.interval[1]
    assert np.log(gap.interval[1] / gap.interval[0]) > 2 * 1.96 * IDEALISED
