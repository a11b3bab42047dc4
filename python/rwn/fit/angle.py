"""The angle that effects of the angle act along where none was recorded."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rwn.fit.budget import one_stage
from rwn.fit.fit import Fitted
from rwn.fit.problem import Target
from rwn.name.screening import Search, foremost

MOST_TRACKS = 4  # times that the angle is simulated anew


def retracked(search: Search, nominal: Fitted, fits: list[Fitted]) -> tuple[Search, Fitted, list[Fitted]]:
    """The same fits with another angle where none was recorded: one that the best fit simulates, or each fit its own.

    The integral of a noisy speed wanders: thirty periods a revolution further on, it has lost the phase. Effects on
    their own angle are the exact equations, but only near the solution a smooth problem.
    """
    best = min([nominal, *fits], key=lambda f: f.cost)
    if not _turns(best) or any(t.position.size for t in search.problem.targets):
        return search, nominal, fits
    other, again = search, best
    for _ in range(MOST_TRACKS):
        tried = _tracked(other, again)
        refitted = tried.refit(again, tried.problem, share=one_stage(search.problem.work))
        if refitted.cost > again.cost - 2.0:
            break
        other, again = tried, refitted
    free = replace(search, problem=replace(search.problem, targets=tuple(map(_on_its_own, search.problem.targets))))
    freed = free.refit(again, free.problem, share=one_stage(search.problem.work))
    if freed.cost < again.cost - 2.0:
        other, again = free, freed
    if other is search:
        return search, nominal, fits
    first, *rest = other.refit_all([nominal, *(f for f in foremost(fits) if f is not best)])
    return other, first, sorted([again, *rest], key=lambda f: f.cost)


def _on_its_own(target: Target) -> Target:
    return replace(target, follows=False)


def _turns(fitted: Fitted) -> bool:
    """Whether an effect of this explanation depends on the angle."""
    return any(fitted.candidate.table[name].turns for name in fitted.added)


def _tracked(search: Search, fitted: Fitted) -> Search:
    """The search on targets whose angle is the one that `fitted` simulates."""
    problem = search.problem
    active = fitted.candidate.active
    angles = [problem.simulate(t, fitted.vector, active).signals["position"] for t in problem.targets]
    targets = tuple(
        replace(t, angle=np.ascontiguousarray(a), angle_from_speed=False, follows=True)
        for t, a in zip(problem.targets, angles, strict=True)
    )
    return replace(search, problem=replace(problem, targets=targets))
