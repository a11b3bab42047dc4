"""Levenberg-Marquardt on small normal equations, with priors and bounds; knows nothing of drives."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import Enum
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rwn.fit.search_coordinates import Evaluate, SearchCoordinates
from rwn.fit.unknown import Unknown
from rwn.simulate.simulator import NormalEquations

Array = NDArray[np.float64]


LEAST = 1e-4  # share of the promised decrease of the cost, that a step has to bring to be taken
UNDAMPED = 1e-10  # damping that holds no step back, even along what priors alone decide
DAMPING = 1e-3  # initial damping of a fit
RELIEF = 1e-2  # factor on the damping where a step promises little


class FitStatus(Enum):
    """How a fit ended; the value says what to do."""

    CONVERGED = "The fit converged."
    ITERATION_LIMIT = "The iteration limit was reached: start closer, with values that are nearer or known better."
    STALLED = "No step improves the fit further: a parameter may be at a bound, or the problem is not smooth."
    DIVERGED = "The simulation diverged at the starting values: check signs and units of the model."


class Simulated(NamedTuple):
    """The normal equations at a point."""

    values: Array  # (p,) in SI
    normal: NormalEquations


@dataclass(frozen=True, kw_only=True)
class Minimum:
    """Where a fit ended."""

    values: Array  # (p,) in SI
    chi2: float  # sum of squared weighted errors, priors aside
    cost: float  # chi2 and priors
    first: float  # cost at the start
    information: Array  # (p, p) J'J and priors by value: the inverse covariance for white residuals of variance 1
    data_information: Array  # (p, p) J'J without priors
    status: FitStatus
    iterations: int
    damping: float = DAMPING  # of the last step, or that the next one wants
    simulated: Simulated | None = None  # the end, as it was simulated with derivatives; None: without any


def minimise(
    evaluate: Evaluate,
    start: Array,
    unknowns: tuple[Unknown, ...],
    *,
    max_iterations: int = 60, tolerance: float = 1e-2, damping: float = DAMPING, prior_scale: float = 1.0,
    probe: Evaluate | None = None, doubt: int = 1, enough: Callable[[], bool] | None = None, roughly: bool = False,
    known: NormalEquations | None = None,
) -> Minimum:  # fmt: skip
    """Levenberg-Marquardt (Nielsen's damping) from `start` (p,) within the unknowns' bounds.

    Ends when a step promises less than `tolerance` of cost, in units of the residual's variance. `prior_scale`: factor
    on the priors, as large as samples are more than independent samples. `probe`: the error without derivatives, which
    is asked before `evaluate` once `doubt` steps in a row were refused. `enough`: asked after every iteration; ends the
    fit as the iteration limit does. `roughly`: where that limit ends the fit, the curvature may be the one before the
    last iteration. `known`: the normal equations at `start`.
    """
    search = SearchCoordinates(evaluate, probe, unknowns, prior_scale)
    z = search.begun(start)
    cost, normal = search.at(z, known)
    if not np.isfinite(cost):
        return _minimum(search, z, normal, normal.chi2, cost, cost, FitStatus.DIVERGED, 0, damping)
    gradient, curvature = search.slopes(z, normal)
    first, chi2, status, exact = cost, normal.chi2, FitStatus.ITERATION_LIMIT, True  # exact: `normal` is at `z`
    growth, count, misses = 2.0, 0, 0
    for count in range(1, max_iterations + 1):
        if count > 1 and enough is not None and enough():
            count -= 1  # reported: of those that were done
            break
        step = _step(search, z, gradient, curvature, damping)
        promised = _promise(step, gradient, curvature)
        if promised <= 0.0 and step.any():  # the ends of ranges stood in the way: shorten towards the gradient
            damping, growth, misses = damping * 10.0, 2.0, misses + 1
            if misses <= 8:
                continue
        little = tolerance * max(1.0, cost / max(1, int(getattr(normal, "count", 1))))
        if promised < little and damping > UNDAMPED:  # does damping alone hold the step back?
            (step, promised, damping), growth = _relieved(search, z, gradient, curvature, damping, little), 2.0
        if promised < little:
            status = FitStatus.CONVERGED
            break
        least = cost - LEAST * promised
        last = roughly and count == max_iterations
        reached, there = search.tried(z + step, least, last=last, doubted=misses >= doubt)
        if reached < least:
            damping *= max(1.0 / 5.0, 1.0 - (2.0 * (cost - reached) / promised - 1.0) ** 3)
            z, cost, chi2, normal, exact = z + step, reached, there.chi2, normal if last else there, not last
            gradient, curvature = search.slopes(z, normal)
            growth, misses = 2.0, 0
        else:
            damping, growth, misses = damping * growth, growth * 2.0, misses + 1
            if misses > 8:
                status = FitStatus.STALLED
                break
    end = _minimum(search, z, normal, chi2, cost, first, status, count, damping)
    return replace(end, simulated=Simulated(end.values, normal) if exact else None)


def _relieved(
    search: SearchCoordinates, z: Array, gradient: Array, curvature: Array, damping: float, little: float
) -> tuple[Array, float, float]:
    """Lowers the damping until a step promises at least `little`, or no further; the step, its promise, its damping."""
    while True:
        damping = max(RELIEF * damping, UNDAMPED)
        step = _step(search, z, gradient, curvature, damping)
        promised = _promise(step, gradient, curvature)
        if promised >= little or damping <= UNDAMPED:
            return step, promised, damping


def _promise(step: Array, gradient: Array, curvature: Array) -> float:
    """Cost that a step removes if the problem is quadratic."""
    return float(2.0 * step @ gradient - step @ curvature @ step)


def _step(search: SearchCoordinates, z: Array, gradient: Array, curvature: Array, damping: float) -> Array:
    """Damped Gauss-Newton step; parameters that would leave their range go to its end, the others answer to that."""
    free = ~(((z <= search.lower) & (gradient < 0)) | ((z >= search.upper) & (gradient > 0)))
    step = np.zeros_like(z)
    low = np.maximum(search.lower - z, -_reach(search))
    high = np.minimum(search.upper - z, _reach(search))
    if not np.isfinite(curvature).all():
        return step
    while free.any():
        held = ~free
        load = gradient[free] - curvature[np.ix_(free, held)] @ step[held]
        part = curvature[np.ix_(free, free)]
        scale = np.sqrt(np.maximum(np.diag(part), 1e-30))
        scaled = part / np.outer(scale, scale) + (damping + 1e-13) * np.eye(scale.size)
        step[free] = np.linalg.solve(scaled, load / scale) / scale
        out = free & ((step < low) | (step > high))
        if not out.any():
            break
        step[out] = np.clip(step, low, high)[out]
        free &= ~out
    return step


def _reach(search: SearchCoordinates) -> Array:
    """No parameter moves by more than a factor of 3, or a third of its range, at once."""
    return np.where(search.logarithmic, 1.1, np.maximum((search.upper - search.lower) / 3.0, 1e-300))


def _minimum(
    search: SearchCoordinates, z: Array, normal: NormalEquations, chi2: float, cost: float, first: float,
    status: FitStatus, count: int, damping: float,
) -> Minimum:  # fmt: skip
    return Minimum(
        values=search.values(z),
        chi2=chi2,
        cost=cost,
        first=first,
        information=search.information(z, normal),
        data_information=normal.curvature,
        status=status,
        iterations=count,
        damping=damping,
    )
