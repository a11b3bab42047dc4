"""Explanations that were found under one measurement, fitted under another, and with one effect less."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from rwn.fit.budget import shares_by_rank
from rwn.fit.fit import NEAR_ITS_END, TO_THE_END, Fit, fit, refit
from rwn.fit.hypothesis import hypothesis
from rwn.fit.problem import Problem
from rwn.fit.residual_noise import with_noise_of
from rwn.model.vocabulary import analog_filters
from rwn.parallel import side_by_side


def refitted_beside(known: Sequence[Fit], problem: Problem) -> list[Fit]:
    """Explanations refitted beside the filters that `problem` fits or that are undone, which are no part of them."""
    undone = {lag.name for s, lag in analog_filters(problem.prior.table).items() if s in problem.filters}
    measured = {n.effect for n in problem.prior.nuisance} | undone

    def again(pair: tuple[Fit, float]) -> Fit:
        this, share = pair
        added = tuple(n for n in this.added if n not in measured)
        starts = {n: this.values_of(n) for n in added}
        return fit(problem, hypothesis(problem.prior, added, problem.scales, starts, this.motor), share=share)

    shares = shares_by_rank(problem.work, [this.cost for this in known])
    return side_by_side(again, list(zip(known, shares, strict=True)))


def under_own_noise(explanation: Fit, problem: Problem) -> tuple[Problem, Fit]:
    """The problem weighted by what an explanation leaves of it, and the explanation fitted to that."""
    (this,) = refitted_beside([explanation], problem)
    problem = with_noise_of(problem, this)
    return problem, refit(this, problem, iterations=NEAR_ITS_END)


def fitted_without(
    problem: Problem, this: Fit, name: str, known: Iterable[Fit], *, iterations: int = TO_THE_END, share: float
) -> Fit:
    """An explanation without one of its effects: as it is `known`, or fitted from where that ended."""
    rest = tuple(n for n in this.added if n != name)
    ready = next((f for f in known if set(f.added) == set(rest)), None)
    if ready is not None:
        return ready
    begun = hypothesis(problem.prior, rest, problem.scales, this.starts(rest), this.motor)
    return fit(problem, begun, max_iterations=iterations, share=share)
