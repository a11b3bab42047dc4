"""The angle that effects of the angle act along where none was recorded."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rwn.fit.budget import one_stage
from rwn.fit.fit import Fit, best_few, refit, refit_all
from rwn.fit.problem import Problem
from rwn.simulate.run import Run

Array = NDArray[np.float64]

MOST_ROUNDS = 4  # times that the angle is simulated anew
GAINED = 2.0  # of cost, one unknown's worth by Akaike's criterion, that another angle has to gain


def along_the_simulated_angle(
    problem: Problem, nominal: Fit, fits: list[Fit]
) -> tuple[Problem, Fit, list[Fit]]:
    """The same fits with another angle where none was recorded: one that the best fit simulates, or each fit its own.

    The integral of a noisy speed wanders: thirty periods a revolution further on, it has lost the phase. Effects on
    their own angle are the exact equations, but only near the solution a smooth problem.
    """
    best = min([nominal, *fits], key=lambda f: f.cost)
    if not _turns(best) or any(r.position.size for r in problem.runs):
        return problem, nominal, fits
    other, again = problem, best
    for _ in range(MOST_ROUNDS):
        tried = _simulated(other, again)
        refitted = refit(again, tried, share=one_stage(problem.work))
        if refitted.cost > again.cost - GAINED:
            break
        other, again = tried, refitted
    free = replace(problem, runs=tuple(map(_on_its_own, problem.runs)))
    freed = refit(again, free, share=one_stage(problem.work))
    if freed.cost < again.cost - GAINED:
        other, again = free, freed
    if other is problem:
        return problem, nominal, fits
    first, *rest = refit_all([nominal, *(f for f in best_few(fits) if f is not best)], other)
    return other, first, sorted([again, *rest], key=lambda f: f.cost)


def _on_its_own(run: Run) -> Run:
    return replace(run, follows=False)


def _turns(this: Fit) -> bool:
    """Whether an effect of this explanation depends on the angle."""
    return any(this.hypothesis.table[name].turns for name in this.added)


def _simulated(problem: Problem, this: Fit) -> Problem:
    """The problem on runs whose angle is the one that `this` simulates."""
    angles = [problem.simulate(r, this.vector, this.active).signals["position"] for r in problem.runs]
    runs = tuple(_following(r, a) for r, a in zip(problem.runs, angles, strict=True))
    return replace(problem, runs=runs)


def _following(run: Run, angle: Array) -> Run:
    """The run with a simulated angle (n,); where it begins stays free if that is unknown."""
    free = run.angle_unknown
    counted = np.ascontiguousarray(angle - angle[0] if free else angle)
    return replace(run, angle=counted, angle_from_speed=False, angle_from_start=free, follows=True)
