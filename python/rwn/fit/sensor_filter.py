"""First-order filters of the sensors, seen in the noise that went through them: nuisance parameters of every fit.

Noise that a filter y_k = phi y_{k-1} + (1 - phi) x_k has passed goes from sample to sample with phi = exp(-T / tau).
A fit that is right but for that leaves such noise and nothing else; differences of the residual show it, since what
else may be missing is smooth between its sharp instants, and few windows hold one.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rwn.fit.budget import shares_by_rank
from rwn.fit.fit import Fit, fit
from rwn.fit.hypothesis import hypothesis
from rwn.fit.prior import Nuisance
from rwn.fit.problem import Problem
from rwn.parallel import side_by_side
from rwn.recording.noise import rough_noise
from rwn.simulate.run import Run

Array = NDArray[np.float64]

LAGS = {"speed": "speed-sensor-lag", "current": "current-sensor-lag"}  # signal -> effect that is its filter
WINDOW = 64  # samples
CERTAIN = 5.0  # standard deviations of the autocorrelation of white noise
LEAST, MOST = 0.1, 0.95  # of phi: a filter faster than half a sample changes nothing
NOTHING_ELSE = 2.0  # variance of what is new in a residual against its rough noise, up to which it is noise alone


@dataclass(frozen=True, kw_only=True)
class SensorFilter:
    """A first-order filter of one signal."""

    signal: str
    share: float  # phi: of a sample's noise that was in the sample before
    time_constant: float  # [s]


def sensor_filters(problem: Problem, residuals: Sequence[Mapping[str, Array]]) -> tuple[SensorFilter, ...]:
    """The filters that the noise of a fit's residuals shows; none of signals that the model filters by itself."""
    found = []
    for signal, lag in LAGS.items():
        parts = [(run, left[signal]) for run, left in zip(problem.runs, residuals, strict=True) if signal in left]
        parts = [(run, x) for run, x in parts if _tells(run, signal, x)]
        if not parts or lag in problem.prior.effects or lag not in problem.prior.table:
            continue
        share = _share([run.masked(signal, x) for run, x in parts])
        if LEAST < share < MOST:
            step = float(np.median([run.sample_time for run, _ in parts]))
            found.append(SensorFilter(signal=signal, share=share, time_constant=-step / float(np.log(share))))
    return tuple(found)


def filtered(problem: Problem, filters: Sequence[SensorFilter]) -> Problem:
    """The problem with the filters among what every hypothesis fits, and with noise that went through them."""
    nuisance = tuple(
        Nuisance(
            effect=LAGS[f.signal], values={"time_constant": f.time_constant}, spread={"time_constant": 1.0}
        )
        for f in filters
    )
    noise = dict(problem.noise)
    for f in filters:
        noise[f.signal] = replace(noise[f.signal], reflection=(f.share,))
    return replace(problem, prior=replace(problem.prior, nuisance=nuisance), noise=noise)


def _tells(run: Run, signal: str, residual: Array) -> bool:
    """Whether its noise is a sensor's: not that of counts or their difference, and larger than its steps."""
    if signal == "speed" and run.speed_measured.is_difference:
        return False
    return rough_noise(residual) > 2.0 * run.quantisation(signal)


def _share(residuals: Sequence[Array]) -> float:
    """phi of the noise of residuals (n,) each; 0 where it may be white, or is not all there is."""
    once, twice = (np.concatenate([_correlations(np.diff(x, n)) for x in residuals]) for n in (1, 2))
    if twice.size < 8:
        return 0.0
    shares = np.linspace(0.0, 0.99, 100)
    expected = np.array([_correlation(p) for p in shares])
    seen = float(np.median(twice))
    if seen < expected[0] + CERTAIN * 1.25 * float(np.std(twice)) / np.sqrt(twice.size):  # deviation of a median
        return 0.0
    share = min(float(np.interp(seen, expected, shares)), 1.0 + 2.0 * float(np.median(once)))
    fresh = [x[1:] - share * x[:-1] for x in residuals]
    loud = max(float(np.nanmean(x**2)) / max(rough_noise(x) ** 2, 1e-300) for x in fresh)
    return share if loud < NOTHING_ELSE else 0.0


def _correlations(x: Array) -> Array:
    """From one sample to the next, of each window of x (n,) that was measured throughout."""
    count = x.size // WINDOW
    windows = x[: count * WINDOW].reshape(count, WINDOW)
    windows = windows[np.isfinite(windows).all(axis=1)]
    energy = np.maximum(np.sum(windows**2, axis=1), 1e-300)
    found: Array = np.sum(windows[:, 1:] * windows[:, :-1], axis=1) / energy * (WINDOW / (WINDOW - 1))
    return found


def _correlation(share: float) -> float:
    """Of second differences, from one sample to the next, of an autoregression of first order."""
    c = share ** np.arange(5.0)
    covariance = [6 * c[0] - 8 * c[1] + 2 * c[2], -4 * c[0] + 7 * c[1] - 4 * c[2] + c[3]]
    return float(covariance[1] / covariance[0])


def refitted_beside(known: Sequence[Fit], problem: Problem) -> list[Fit]:
    """Explanations refitted beside the filters that `problem` fits, which are no part of them there."""
    measured = {n.effect for n in problem.prior.nuisance}

    def again(pair: tuple[Fit, float]) -> Fit:
        this, share = pair
        added = tuple(n for n in this.added if n not in measured)
        starts = {n: this.values_of(n) for n in added}
        return fit(problem, hypothesis(problem.prior, added, problem.scales, starts, this.motor), share=share)

    shares = shares_by_rank(problem.work, [this.cost for this in known])
    return side_by_side(again, list(zip(known, shares, strict=True)))
