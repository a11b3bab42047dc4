"""Fits of a transfer function under coloured noise: what it leaves are disturbances that last, not independent samples.

An error counts as what is new in it beyond the share, its `persistence`, of the one before (generalised least squares;
Cochrane, Orcutt 1949). Plain least squares bends the coefficients after every slow disturbance of the fitted samples.
The persistence is that of a plain fit: estimated anew from fit to fit it runs to 1, where the level counts for nothing.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rwn import evidence
from rwn.evidence import Statistics
from rwn.fitted import Fitted
from rwn.output_error import OutputError
from rwn.search import Search

Array = NDArray[np.float64]
MOST = 0.99  # persistence that is believed


def under_coloured_noise(search: Search, fitted: Fitted) -> Search:
    """`search` weighted by what is new in each error that a plain fit leaves."""
    problem = search.problem
    persistence, noise = dict(problem.persistence), dict(problem.noise)
    for signal, errors in _errors(problem, fitted):
        before, after = np.concatenate([e[:-1] for e in errors]), np.concatenate([e[1:] for e in errors])
        both = np.isfinite(before) & np.isfinite(after)
        before, after = before[both], after[both]
        share = float(np.clip(before @ after / max(float(before @ before), 1e-300), 0.0, MOST))
        persistence[signal] = share
        noise[signal] = max(float(np.std(after - share * before)), 1e-12)
    return replace(search, problem=replace(problem, persistence=persistence, noise=noise, colour=1.0))


def innovations(problem: OutputError, fitted: Fitted) -> Statistics:
    """Statistics of what is new in each error of a fit: the errors themselves where no persistence is known."""
    news = [
        {s: r[1:] - problem.persistence.get(s, 0.0) * r[:-1] for s, r in residual.items()}
        for residual in problem.residuals(fitted.vector, fitted.candidate.active)
    ]
    return evidence.statistics_of(evidence.join(problem, news))


def _errors(problem: OutputError, fitted: Fitted) -> Iterator[tuple[str, list[Array]]]:
    residuals = problem.residuals(fitted.vector, fitted.candidate.active)
    for signal in problem.noise:
        yield signal, [r[signal] for r in residuals if signal in r]
