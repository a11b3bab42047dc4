"""Fits where the error is not smooth: a contact met a little earlier changes all that follows, and derivatives mislead.

Seen from farther off the error is smooth: a bowl with ripples. Gauss-Newton steps with secants over steps longer than
the ripples go down it, coarse to fine (graduated optimisation: Blake, Zisserman 1987), before derivatives take over.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rwn.fit.budget import shares_by_rank
from rwn.fit.fit import Fit, fit
from rwn.fit.hypothesis import Hypothesis
from rwn.fit.levenberg_marquardt import Minimum, minimise
from rwn.fit.problem import Problem
from rwn.fit.residuals import join
from rwn.fit.unknown import Unknown
from rwn.parallel import side_by_side
from rwn.simulate.simulator import NormalEquations

Array = NDArray[np.float64]

SECANTS = (0.2, 0.06, 0.02)  # relative steps, coarse to fine
STEPS = 6  # most iterations by secants of one relative step
ITERATIONS = 12  # most of the fit by derivatives that ends a turn
GAIN = 2e-3  # least relative gain in cost that is worth another turn, or a finer secant
TURNS = 3  # most turns, by secants and then by derivatives, of a fit that may be the best
RIVAL = 2.0  # cost in units of the best, up to which a fit may still turn out to be better
NEAR_ZERO = 0.02  # share of its range or prior that a parameter near zero counts as, for a step relative to its size


def nonsmooth_unknowns(this: Hypothesis, *names: str) -> list[int]:
    """The unknowns of effects that idealise a contact, all or among `names`; empty where the error is smooth."""
    owners = {name for name in names or this.effects if any(p.idealised for p in this.table[name].parameters)}
    return [k for k, u in enumerate(this.unknowns) if u.name.partition(".")[0] in owners and u.lower > 0.0]


def down_secants(problem: Problem, start: Fit, *, turns: int, share: float = np.inf) -> Fit:
    """A fit gone on from `start` by secants, then by derivatives, up to `turns` times while that gains.

    It is `start` itself where the error is smooth. `share`: what it may cost; each part takes one iteration at least.
    """
    this, best, own = start.hypothesis, start, problem.metered()
    for _ in range(turns if nonsmooth_unknowns(this) else 0):
        values = best.minimum.values
        for relative in SECANTS:
            found = _by_secants(own, this.starting_at(values), relative, share)
            values = found.values
            if found.cost > (1.0 - GAIN) * found.first:
                break  # the bowl is left, and what remains are ripples
        again = fit(own, this.starting_at(values), max_iterations=ITERATIONS, share=share - own.work.done)
        gained = again.cost < (1.0 - GAIN) * best.cost
        best = min(best, again, key=lambda f: f.cost)
        if not gained or own.work.done >= share:
            break
    problem.work.add(own.work.done)
    return replace(best, hypothesis=this)


def all_down_secants(problem: Problem, nominal: Fit, fits: Sequence[Fit]) -> list[Fit]:
    """The fits, those that may yet be the best gone on from by `down_secants`."""
    bar = RIVAL * min(f.cost for f in (nominal, *fits))
    worth = [f for f in fits if f.cost < bar and nonsmooth_unknowns(f.hypothesis)]
    shares = shares_by_rank(problem.work, [f.cost for f in worth])
    ends = side_by_side(
        lambda pair: down_secants(problem, pair[0], turns=TURNS, share=pair[1]), zip(worth, shares, strict=True)
    )
    better = {id(f): end for f, end in zip(worth, ends, strict=True)}
    return [better.get(id(f), f) for f in fits]


def _by_secants(problem: Problem, this: Hypothesis, relative: float, share: float) -> Minimum:
    """Where Levenberg-Marquardt ends with the slopes of secants over `relative` steps in place of derivatives.

    Or where the problem's meter has come to `share`.
    """

    def probe(values: Array) -> NormalEquations:
        error = weighted_errors(problem, this, values)
        return _normal(error, np.empty((error.size, 0)))

    def evaluate(values: Array) -> NormalEquations:
        error = weighted_errors(problem, this, values)
        return _normal(error, slopes_by_secants(problem, this, values, relative))

    with _overflowing():
        return minimise(
            evaluate, this.start, this.unknowns, max_iterations=STEPS, tolerance=GAIN * problem.samples,
            prior_scale=problem.inflation, probe=probe, doubt=0, enough=lambda: problem.work.done >= share,
        )  # fmt: skip


def slopes_by_secants(problem: Problem, this: Hypothesis, values: Array, relative: float) -> Array:
    """Derivatives (n, p) of what is simulated by the unknowns, in units of the noise: secants over `relative` steps."""

    def slope(k: int) -> Array | None:
        low, high = _sides(this.unknowns[k], float(values[k]), relative)
        if high <= low:
            return None
        below, above = (weighted_errors(problem, this, _with(values, k, v)) for v in (low, high))
        return (below - above) / (high - low)  # the error is recorded minus simulated

    columns = side_by_side(slope, range(values.size))
    slopes = np.zeros((problem.samples, values.size))
    for k, column in enumerate(columns):
        if column is not None:
            slopes[:, k] = column
    return slopes


def _normal(error: Array, slopes: Array) -> NormalEquations:
    chi2 = float(error @ error)
    return NormalEquations(
        chi2=chi2, gradient=slopes.T @ error, curvature=slopes.T @ slopes, count=error.size,
        finite=bool(np.isfinite(chi2)),
    )  # fmt: skip


def _overflowing() -> np.errstate:
    """A run that leaves the finite numbers is a step taken back."""
    return np.errstate(over="ignore", invalid="ignore")


def _sides(unknown: Unknown, value: float, relative: float) -> tuple[float, float]:
    """Ends of the secant about a value, within its limits."""
    size = abs(value)
    if not unknown.logarithmic:
        span = unknown.upper - unknown.lower
        size = max(size, NEAR_ZERO * span if np.isfinite(span) else 0.0, NEAR_ZERO * abs(unknown.prior or 0.0))
    return max(value - relative * size, unknown.lower), min(value + relative * size, unknown.upper)


def _with(values: Array, k: int, value: float) -> Array:
    moved = values.copy()
    moved[k] = value
    return moved


def weighted_errors(problem: Problem, this: Hypothesis, values: Array) -> Array:
    """Errors (n,) of all recordings and signals in units of the noise, end to end; 0 where nothing was recorded."""
    with _overflowing():  # of every thread its own
        errors = join(problem, problem.residuals(this.with_values(values), this.active))
        weighted: Array = np.nan_to_num(np.concatenate(list(errors.values())))
    return weighted
