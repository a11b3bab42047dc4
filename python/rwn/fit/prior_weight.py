"""How much a declared uncertainty weighs against residuals that are coloured and larger than the noise.

Where physics is missing, thousands of samples repeat the same misfit, and against them as independent samples no prior
holds: a refit then moves a resistance by a hundred declared standard deviations to absorb friction. A fit that has left
the declared range is repeated with its samples counted at what they are worth, N / (variance x correlation time).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rwn.fit import residuals as evidence
from rwn.fit.budget import one_stage
from rwn.fit.fit import Fitted
from rwn.name.screening import Search
from rwn.report.diagnosis import BELIEVABLE

WHITE = 2.0  # variance times correlation time below which nothing but noise is left


def tempered(search: Search, fitted: Fitted) -> tuple[Search, Fitted]:
    """`search` with priors weighed against what `fitted` leaves, once a fit has left what is believable.

    With it `fitted`, or where it goes without that weight if it leaves noise alone there.
    """
    if search.problem.colour == 1.0 and farthest(fitted) < BELIEVABLE:
        return search, fitted
    colour = _colour(search, fitted)
    free = search.refit(fitted, replace(search.problem, colour=1.0), share=one_stage(search.problem.work))
    if _colour(search, free) < WHITE:  # what was left were the priors' own doing
        colour, fitted = 1.0, free
    # exactly 1 would forget that the fits had run away once
    return replace(search, problem=replace(search.problem, colour=max(colour, 1.0 + 1e-9))), fitted


def _colour(search: Search, fitted: Fitted) -> float:
    left = evidence.statistics(search.problem, fitted)
    return max(1.0, left.variance * left.correlation_time)


def farthest(fitted: Fitted) -> float:
    """Largest move of a nominal parameter from its given value, in declared standard deviations."""
    moves = [0.0]
    for u, value in zip(fitted.candidate.unknowns, fitted.minimum.values, strict=True):
        if u.prior is None or not np.isfinite(u.prior_std) or u.prior_std <= 0.0 or u.prior == 0.0:
            continue
        ratio = value / u.prior
        logarithmic = u.logarithmic and ratio > 0.0
        moves.append(abs(np.log(ratio) if logarithmic else ratio - 1.0) / u.prior_std)
    return float(max(moves))
