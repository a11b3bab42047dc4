"""Which effects are tried beside an explanation of which a step is dear."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from rwn.fit.budget import LEAST, TOTAL
from rwn.fit.fit import Fit, cost_of_a_step, fit_nominal
from rwn.fit.problem import Problem
from rwn.name import affordable as module
from rwn.name.affordable import STEPS, affordable
from rwn.name.extending import beside
from rwn.name.not_tried import NotTried
from rwn.name.ranking import NO_EXTENSIONS

NAMES = ["input-delay", "coulomb-friction", "quadratic-drag", "unbalance"]


def _paid_for(problem: Problem, base: Fit, names: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """What is left pays for so many effects beside an explanation."""
    step = cost_of_a_step(problem, base.hypothesis, base.vector)
    monkeypatch.setattr(module, "left", lambda _work: names * STEPS * step)


def test_beside_a_usual_explanation_all_are_tried_however_much_was_spent(problem: Problem) -> None:
    base = fit_nominal(problem)
    assert STEPS * 40 * cost_of_a_step(problem, base.hypothesis, base.vector) < LEAST * TOTAL
    assert affordable(problem, base, NAMES, ()) == NAMES


def test_of_a_dear_step_those_are_tried_that_explain_most_alone(
    problem: Problem, fit_with: Callable[[str], Fit], monkeypatch: pytest.MonkeyPatch
) -> None:
    base, alone = fit_nominal(problem), [fit_with(name) for name in NAMES[:3]]
    _paid_for(problem, base, 2.5, monkeypatch)
    best, second, *_ = (f.added[0] for f in sorted(alone, key=lambda f: f.cost))
    assert best == "coulomb-friction"
    assert affordable(problem, base, NAMES, alone) == [n for n in NAMES if n in (best, second)]
    assert affordable(problem, base, NAMES[3:], alone) == NAMES[3:], "what is met nowhere comes last, not never"
    _paid_for(problem, base, 0.9, monkeypatch)
    assert affordable(problem, base, NAMES, alone) == []


def test_a_search_says_that_not_all_were_tried(
    problem: Problem, fit_with: Callable[[str], Fit], monkeypatch: pytest.MonkeyPatch
) -> None:
    base, wanted = fit_with("quadratic-drag"), ["input-delay", "quadratic-drag", "unbalance"]
    none = [NotTried(beside=("quadratic-drag",), effects=("input-delay", "unbalance"))]
    for count, tried, left in ((9.0, set(wanted), []), (0.0, set(), none)):
        _paid_for(problem, base, count, monkeypatch)
        found = beside(problem, [base], wanted, [base], NO_EXTENSIONS)
        assert ({name for _, name in found.tried}, list(found.not_tried)) == (tried, left)
