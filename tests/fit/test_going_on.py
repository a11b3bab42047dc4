"""A fit that goes on from where one of the same problem ended does not simulate its start again."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from demo_problem import demo_problem
from rwn.fit.fit import Fit, fit, refit
from rwn.fit.hypothesis import hypothesis
from rwn.fit.problem import Problem


@pytest.fixture(scope="module")
def problem() -> Problem:
    """The recording of the demo, prepared."""
    return demo_problem()


@pytest.fixture(scope="module")
def begun(problem: Problem) -> Fit:
    """A fit that has not come to its end."""
    return fit(problem, hypothesis(problem.prior, ("cogging-torque",), problem.scales), max_iterations=1)


def _work(problem: Problem, this: Fit) -> tuple[int, Fit]:
    before = problem.work.done
    again = refit(this, problem, iterations=1)
    return problem.work.done - before, again


def test_the_end_of_a_fit_is_not_simulated_again(problem: Problem, begun: Fit) -> None:
    """It comes to the same end, for one simulation of two."""
    spared, gone_on = _work(problem, begun)
    whole, anew = _work(problem, replace(begun, problem=None))
    assert spared == pytest.approx(0.5 * whole, rel=0.05)
    assert gone_on.cost == pytest.approx(anew.cost, rel=1e-12)
    np.testing.assert_allclose(gone_on.minimum.values, anew.minimum.values, rtol=1e-9)


def test_the_end_of_another_problem_is(problem: Problem, begun: Fit) -> None:
    """Under another noise the same motion costs something else."""
    other = replace(problem, noise={s: replace(n, level=2.0 * n.level) for s, n in problem.noise.items()})
    assert refit(begun, other, iterations=1).minimum.first == pytest.approx(begun.minimum.chi2 / 4.0, rel=0.2)


def test_values_that_were_moved_are(problem: Problem, begun: Fit) -> None:
    """What was simulated at the end says nothing of elsewhere."""
    k = [u.name for u in begun.hypothesis.unknowns].index("inertia")
    values = begun.minimum.values.copy()
    values[k] *= 1.5
    moved = replace(begun, minimum=replace(begun.minimum, values=values))
    first = refit(moved, problem, iterations=1).minimum.first
    assert first == pytest.approx(refit(replace(moved, problem=None), problem, iterations=1).minimum.first, rel=1e-12)
    assert first > 1.1 * begun.cost


def test_a_curvature_of_before_the_last_iteration_is_not_kept(problem: Problem) -> None:
    """A rough fit does not know its end."""
    this = hypothesis(problem.prior, ("cogging-torque",), problem.scales)
    assert fit(problem, this, max_iterations=1, roughly=True).minimum.simulated is None
