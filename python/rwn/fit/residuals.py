"""What a fit leaves: how much, how coloured, and how many independent samples it is worth."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from statistics import NormalDist
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from rwn.fit.disturbance import distance_from_disturbance
from rwn.fit.fit import Fit
from rwn.fit.problem import Problem
from rwn.fit.whiteness import distance_from_level
from rwn.recording.noise import WHITE
from rwn.recording.signals import DRIVING_FORCE
from rwn.simulate.linear_response import speed_filter
from rwn.simulate.run import Run
from rwn.simulate.simulator import RAN_AWAY

Array = NDArray[np.float64]

LEVEL = 0.01  # of the test whether what is left has structure, and whether one simulation is worse than another
NO_DIFFERENCES: Mapping[str, int] = MappingProxyType({})
CERTAINLY = NormalDist().inv_cdf(1.0 - LEVEL)  # deviations (`loss_gained`) that a test at LEVEL asks for
NEGLIGIBLE = 1.05  # variance in units of the noise below which no structure counts: noise is known to that
MISSPECIFIED = 50.0  # most independent samples that a residual counts for which is all misfit
EXACT_TO = 1e-3  # share of its squared error to which a simulation is exact
MOST_SAMPLES = 1.0 / EXACT_TO  # most independent samples that noise counts for


@dataclass(frozen=True, kw_only=True)
class Statistics:
    """What is left of a fit."""

    count: int  # samples
    variance: float  # mean squared weighted error; 1: the noise alone
    correlation_time: float  # integrated autocorrelation time, in samples; 1: white
    structured: tuple[str, ...] = ()  # the signals in which it is not noise (see `structured`)

    @property
    def at_the_floor(self) -> bool:
        """Whether the residual may be measurement noise alone: it has no structure, or little is left."""
        return not self.structured or self.variance < NEGLIGIBLE

    @property
    def effective(self) -> float:
        """Effective number of independent samples."""
        return self.count / self.correlation_time

    @property
    def misfit(self) -> float:
        """Share of its square that is no noise but what the model lacks."""
        return misfit(self.variance, self.structured)

    @property
    def most_independent(self) -> float:
        """How many samples it may count for, however long the recordings: a wrong model is wrong systematically.

        What is left above the noise is misfit, and has few independent samples; the noise beside it has more.
        """
        return 1.0 / ((1.0 - self.misfit) / MOST_SAMPLES + self.misfit / MISSPECIFIED)

    @property
    def independent(self) -> float:
        """How many independent samples it counts for."""
        return min(self.effective, self.most_independent)

    @property
    def effective_with_misfit(self) -> float:
        """Effective number of samples by which it tells values: noise all that it is worth, misfit few."""
        of_misfit = min(self.effective, MISSPECIFIED)
        return 1.0 / ((1.0 - self.misfit) / self.effective + self.misfit / of_misfit) if of_misfit else 0.0


def misfit(variance: float, structured: Collection[str]) -> float:
    """Share of a mean squared error, in units of the noise, that is no noise; 0 without structure, or of little."""
    return 1.0 - 1.0 / variance if structured and variance >= NEGLIGIBLE else 0.0


def correlation_time(x: Array) -> float:
    """Integrated autocorrelation time 1 + 2 sum rho_k of x (n,), in samples, at least 1 (Sokal's window)."""
    x = x[np.isfinite(x)] - np.nanmean(x)
    n = x.size
    if n < 8 or not np.any(x):
        return 1.0
    size = 1 << (2 * n - 1).bit_length()  # a length with a large prime factor takes ten times as long
    rho = np.fft.irfft(_power(np.fft.rfft(x, size)))[:n]
    sums = 2.0 * np.cumsum(rho / rho[0]) - 1.0
    inside = np.nonzero(np.arange(n) >= 5.0 * sums)[0]
    return float(max(1.0, sums[inside[0] if inside.size else n - 1]))


def structured(problem: Problem, this: Fit) -> tuple[str, ...]:
    """The signals in which a fit leaves more than noise; of the position, more than a torque new in each row does."""
    residuals = problem.residuals(this.vector, this.active)
    return _structured(problem, this, residuals, join(problem, residuals))


def _structured(
    problem: Problem, this: Fit, residuals: Sequence[Mapping[str, Array]], joined: Mapping[str, Array]
) -> tuple[str, ...]:  # fmt: skip
    ways = [run.speed_measured for run in problem.runs if run.speed_measured.shows_counts]
    differences = {"speed": max(way.before + way.after for way in ways)} if ways else {}
    found = structured_of(joined, differences={**differences, DRIVING_FORCE: 1})  # it holds the acceleration
    if "position" not in found or _errs_as_disturbed(problem, this, residuals):
        return tuple(s for s in found if s != "position")
    return found


def _errs_as_disturbed(problem: Problem, this: Fit, residuals: Sequence[Mapping[str, Array]]) -> bool:
    """Whether the position of every free run errs as under white torque (see `disturbance`), by the same test."""
    pairs = [(run, left["position"]) for run, left in zip(problem.runs, residuals, strict=True) if "position" in left]
    if problem.drive.coefficients or any(run.restart_every for run, _ in pairs):
        return False
    shares = [speed_filter(problem.drive, this.vector, run.sample_time)[0] for run, _ in pairs]
    found = [
        distance_from_disturbance(run.masked("position", error), share)
        for (run, error), share in zip(pairs, shares, strict=True)
    ]
    return max(found) < _most_distant(len(found))


def structured_of(joined: Mapping[str, Array], *, differences: Mapping[str, int] = NO_DIFFERENCES) -> tuple[str, ...]:
    """The signals whose errors are not white: Bartlett's test of the cumulative periodogram at LEVEL, over all of them.

    White noise is found to have structure in one case of 1 / LEVEL, whatever the number of samples (n,). The noise of
    `differences` over so many samples is fast up to half the rate of these: of such signals only slow errors are
    structure.
    """
    limit = _most_distant(len(joined))
    return tuple(s for s, x in joined.items() if _distance_from_white(x, over=differences.get(s, 0)) > limit)


def _most_distant(tests: int) -> float:
    """Distance that one of so many cumulative periodograms of noise exceeds in one case of 1 / LEVEL."""
    return float(np.sqrt(-0.5 * np.log(0.5 * LEVEL / max(tests, 1))))  # Kolmogorov, Smirnov


def _distance_from_white(x: Array, *, over: int = 0) -> float:
    """sqrt(m) times the largest distance of the cumulative periodogram of m frequencies from a straight line.

    `over`: samples of a difference, below half the rate of which only what is above the line counts; 0: none.
    """
    if np.nanmax(np.abs(x), initial=0.0) ** 2 > RAN_AWAY:
        return np.inf
    x = np.where(np.isfinite(x), x, 0.0)
    power = _power(np.fft.rfft(x))[1 : (x.size + 1) // 2 // max(over, 1)]
    if power.size < 8 or not power.any():
        return 0.0
    return distance_from_level(power, fast=not over)


def _power(spectrum: NDArray[np.complex128]) -> Array:
    power: Array = spectrum.real**2 + spectrum.imag**2
    return power


def statistics(problem: Problem, this: Fit, *, drift: bool = True) -> Statistics:
    """Residual statistics of a fit, over all recordings and signals.

    `drift`: also of the position where other signals tell the motion too; its errors then hold what it drifts by.
    """
    residuals = problem.residuals(this.vector, this.active)
    joined = join(problem, residuals)
    if not drift and len(joined) > 1:
        joined.pop("position", None)
    return statistics_of(joined, structured=_structured(problem, this, residuals, joined))


def variances(problem: Problem, this: Fit) -> dict[str, float]:
    """Mean squared weighted error of a fit by signal, over all recordings; 1: the noise alone, inf: it ran away."""
    joined = join(problem, problem.residuals(this.vector, this.active))
    found = {s: float(np.nanmean(r**2)) if np.isfinite(r).any() else 0.0 for s, r in joined.items()}
    return {s: v if v < RAN_AWAY else np.inf for s, v in found.items()}


def variance(problem: Problem, this: Fit) -> float:
    """Mean squared weighted error of a fit over all recordings and signals; 1: noise alone, inf: it ran away."""
    joined = join(problem, problem.residuals(this.vector, this.active))
    left = sum(_energies(joined).values()) / max(_count(joined), 1)
    return left if left < RAN_AWAY else np.inf


def loss_gained(before: Array, after: Array) -> float:
    """How certainly a simulation of losses (n,) `after` is worse than one of those `before`, in deviations.

    0 where both do it alike, infinite where one of them ran away. Diebold, Mariano (1995): the mean difference of
    squared weighted errors over its own deviation, which counts how long differences last.
    """
    ran_away = [not float(np.max(x)) < RAN_AWAY for x in (before, after)]
    if any(ran_away):
        return 0.0 if all(ran_away) else -np.inf if ran_away[0] else np.inf
    difference = after - before
    spread = float(np.std(difference)) * np.sqrt(correlation_time(difference) / difference.size)
    return float(np.mean(difference)) / spread if spread > 0.0 else 0.0


def losses(problem: Problem, residuals: Sequence[Mapping[str, Array]]) -> Array:
    """Squared weighted error of each sample, all signals together; 0 where nothing is compared.

    `residuals`: (n,) of each run, by signal.
    """

    def of_a_run(left: Mapping[str, Array]) -> Array:
        squares: Array = np.sum([np.square(x / problem.noise[s].level) for s, x in left.items()], axis=0)
        return squares

    return np.concatenate(list(map(of_a_run, residuals)))


def statistics_of(joined: Mapping[str, Array], *, structured: tuple[str, ...]) -> Statistics:
    """Statistics of weighted residuals (n,) by signal, of which some are `structured`."""
    energies, count = _energies(joined), _count(joined)
    whole = sum(energies.values())
    if whole > RAN_AWAY:  # a simulation that ran away shows one thing
        away = tuple(joined)
        return Statistics(count=count, variance=np.inf, correlation_time=float(max(count, 1)), structured=away)
    correlated = sum(energies[s] * correlation_time(r) for s, r in joined.items())
    return Statistics(
        count=count,
        variance=whole / max(count, 1),
        correlation_time=max(1.0, correlated / whole) if whole else 1.0,
        structured=structured,
    )


def _energies(joined: Mapping[str, Array]) -> dict[str, float]:
    return {s: float(np.nansum(r**2)) for s, r in joined.items()}


def _count(joined: Mapping[str, Array]) -> int:
    return sum(int(np.isfinite(r).sum()) for r in joined.values())


def join(problem: Problem, residuals: Sequence[Mapping[str, Array]]) -> dict[str, Array]:
    """What is new in the residuals (n,) of each signal, in units of its noise, recordings end to end.

    NaN where nothing is compared.
    """
    pairs = list(zip(problem.runs, residuals, strict=True))
    signals = sorted({s for r in residuals for s in r})
    return {s: np.concatenate([_innovations(problem, run, s, r[s]) for run, r in pairs if s in r]) for s in signals}


def _innovations(problem: Problem, run: Run, signal: str, residual: Array) -> Array:
    noise = problem.noise.get(signal, WHITE)
    return noise.innovations(run.masked(signal, residual), restart=run.restart_every)
