"""How much a declared uncertainty weighs against residuals that are coloured and larger than the noise.

Where physics is missing, thousands of samples repeat the same misfit, and against them as independent samples no prior
holds: a refit then moves a resistance by a hundred declared standard deviations to absorb friction. A fit that has left
the declared range is repeated with its samples counted at what they are worth, N / (variance x correlation time).
"""

from __future__ import annotations

from dataclasses import replace

from rwn.fit.budget import one_stage
from rwn.fit.fit import Fit, refit
from rwn.fit.problem import Problem
from rwn.fit.residuals import statistics

BELIEVABLE = 4.0  # declared standard deviations, beyond which a parameter is not merely off
LEFT_BY_NOISE = 2.0  # variance times correlation time below which nothing but noise is left


def with_priors_weighed(problem: Problem, this: Fit) -> tuple[Problem, Fit]:
    """`problem` with priors weighed against what `this` leaves, once a fit has left what is believable.

    With it `this`, or where it goes without that weight if it leaves noise alone there.
    """
    if problem.inflation == 1.0 and this.farthest_move < BELIEVABLE:
        return problem, this
    inflation = variance_inflation(problem, this)
    free = refit(this, replace(problem, inflation=1.0), share=one_stage(problem.work))
    if variance_inflation(problem, free) < LEFT_BY_NOISE:  # what was left were the priors' own doing
        inflation, this = 1.0, free
    # an inflation of exactly 1 means that no fit has left what is believable yet
    return replace(problem, inflation=max(inflation, 1.0 + 1e-9)), this


def variance_inflation(problem: Problem, this: Fit) -> float:
    """Variance of what a fit leaves, in units of the noise, times its correlation time in samples; at least 1.

    So many of its samples count as one.
    """
    left = statistics(problem, this)
    return max(1.0, left.variance * left.correlation_time)
