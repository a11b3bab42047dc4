"""What a search costs is counted, and what it may cost is kept to."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from demo_problem import demo_problem
from made_up_motor import MOTOR, recorded
from ranked import ranked
from rwn import _core
from rwn.fit import budget
from rwn.fit.fit import cost_of_a_step, fit, fit_nominal
from rwn.fit.hypothesis import hypothesis
from rwn.fit.preparation import prepare
from rwn.fit.problem import Problem
from rwn.name.screening import screen
from rwn.parallel import thread_pool

LATE = ["quadratic-drag", "input-delay"]  # neither is what is missing in the demo


def _cost(problem: Problem, derivatives: int, name: str = "") -> int:
    known = demo_problem()
    this = hypothesis(known.prior, (name,) if name else (), known.scales)
    own = problem.metered()
    own.normal(this.vector, this.active, this.by[:derivatives])
    return own.work.done


def _spent(share: float) -> _core.Work:
    work = _core.Work()
    work.add(int(share * budget.TOTAL))
    return work


def test_a_run_costs_by_its_length_its_derivatives_and_its_equations() -> None:
    problem = demo_problem()
    once = _cost(problem, 0)
    assert once == _cost(problem, 0) > 0
    half = replace(problem, runs=tuple(r.until(r.time.size // 2) for r in problem.runs))
    assert _cost(half, 0) == pytest.approx(once / 2, rel=0.1)
    assert once < _cost(problem, 4) < _cost(problem, 4, "stribeck-friction") < _cost(problem, 4, "backlash")


def test_what_a_step_costs_is_told_from_the_beginning_of_the_recordings() -> None:
    problem = demo_problem()
    for name in ("quadratic-drag", "shaft-compliance"):
        this = hypothesis(problem.prior, (name,), problem.scales)
        own = problem.metered()
        own.normal(this.vector, this.active, this.by)
        assert cost_of_a_step(problem, this) == pytest.approx(own.work.done, rel=0.2)
    assert 0 < problem.work.done < own.work.done  # measuring is counted too


def test_what_a_search_costs_does_not_depend_on_threads() -> None:
    costs = []
    for jobs in (1, 2):
        problem = demo_problem()
        with thread_pool(jobs):
            ranked(problem, LATE)
        costs.append(problem.work.done)
    assert costs[0] == costs[1] > 0


def test_a_fit_ends_with_its_share() -> None:
    problem = demo_problem()
    this = hypothesis(problem.prior, ("stribeck-friction",), problem.scales)
    whole = fit(problem, this)
    assert whole.minimum.iterations > 3
    begun = problem.work.done
    least = fit(problem, this, share=0.0)
    assert least.minimum.iterations == 1
    assert whole.cost < least.cost < least.minimum.first
    assert 0 < problem.work.done - begun < 0.5 * begun


def test_shares_are_those_of_a_stage() -> None:
    work = _spent(0.5)
    stage = budget.STAGE * 0.5 * budget.TOTAL
    assert budget.one_stage(work) == pytest.approx(stage)
    assert budget.equal_shares(work, 4) == pytest.approx([stage / 4] * 4)
    shares = budget.shares_by_rank(work, [3.0, 1.0, 2.0])
    assert sum(shares) == pytest.approx(stage)
    assert shares[1] == pytest.approx(2.0 * shares[2]) == pytest.approx(3.0 * shares[0])
    assert budget.shares_by_rank(work, []) == []
    assert budget.shares_of_steps(work, [1.0, 3.0]) == pytest.approx([0.25 * stage, 0.75 * stage])
    assert budget.shares_of_steps(work, []) == []


def test_something_is_left_however_much_was_spent() -> None:
    assert budget.left(_spent(5.0)) == pytest.approx(budget.LEAST * budget.TOTAL)
    assert budget.affords_more(_spent(0.6))
    assert not budget.affords_more(_spent(0.8))


def test_where_the_budget_is_spent_more_effects_are_tried_beside_the_best_alone() -> None:
    names = [*LATE, "magnetic-saturation"]
    ranking = ranked(demo_problem(_spent(0.9)), names)
    assert len({base for base, _ in ranking.extensions.tried}) == 1
    whole = ranked(demo_problem(), names)
    assert not whole.not_tried
    assert len({base for base, _ in whole.extensions.tried}) == 2
    (left,) = ranking.not_tried
    more = whole.extensions.tried - ranking.extensions.tried
    assert {(left.beside, name) for name in left.effects} == {(base, name) for base, name in more if name not in base}
    assert whole.closest.cost <= ranking.closest.cost


def test_pairs_that_are_known_are_weighed_though_nothing_is_left_to_try_more() -> None:
    names = ["unbalance", "quadratic-drag"]
    both = recorded(1, lambda speed, angle: -0.004 * np.sin(angle) - 1e-5 * speed * abs(speed), 1000)

    def problem(spent: float) -> Problem:
        return prepare([both], rwn.Model(kind="dc", parameters=MOTOR), work=_spent(spent))

    pairs = ranked(problem(0.0), names)
    again = ranked(problem(0.9), names, after=pairs)
    assert set(again.closest.added) == set(pairs.closest.added) == set(names)
    assert not again.not_tried  # what is left is noise: nothing more would have been tried


def test_more_effort_leaves_more() -> None:
    usual, more, less = (budget.meter(effort) for effort in (1.0, 3.0, 0.5))
    assert budget.left(usual) == budget.TOTAL
    assert budget.left(more) == pytest.approx(3.0 * budget.TOTAL)
    assert budget.left(less) == pytest.approx(0.5 * budget.TOTAL)


def test_a_search_by_more_effects_or_under_another_measurement_has_a_budget_of_its_own() -> None:
    work = _spent(0.2)
    begun = work.done
    work.add(round(0.7 * budget.TOTAL))
    budget.renew(work, begun)
    assert work.done == begun


@pytest.mark.slow
def test_a_search_that_was_cut_short_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    model = rwn.Model(kind="dc", parameters=MOTOR)
    wavy = recorded(1, lambda speed, angle: 0.02 * np.sin(3.0 * angle) * np.cos(7.0 * angle) - 1e-7 * speed**3, 1000)
    warnings = [rwn.diagnose([wavy], model).warnings]
    monkeypatch.setattr(budget, "TOTAL", 1e8)
    warnings.append(rwn.diagnose([wavy], model).warnings)
    assert ["not tried in addition to" in " ".join(texts) for texts in warnings] == [False, True]


def test_the_search_that_looks_no_further_still_finds_what_is_missing() -> None:
    problem = demo_problem(_spent(5.0))
    assert screen(problem, fit_nominal(problem), ["coulomb-friction", *LATE])[0].added == ("coulomb-friction",)
