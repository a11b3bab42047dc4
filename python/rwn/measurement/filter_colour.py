"""First-order filters of sensors, as the colour of their noise shows them.

Noise that a filter y_k = phi y_{k-1} + (1 - phi) x_k has passed goes from sample to sample with phi = exp(-T / tau).
Differences of the residual show it, since what else may be missing is smooth between its sharp instants, and few
windows hold one.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rwn.fit.problem import Problem
from rwn.model.vocabulary import analog_filters
from rwn.recording.noise import noise_from_differences
from rwn.simulate.run import Run

Array = NDArray[np.float64]

WINDOW = 64  # samples
CERTAIN = 5.0  # standard deviations of the autocorrelation of white noise
LEAST, MOST = 0.1, 0.95  # of phi: a filter faster than half a sample changes nothing, a slower one is physics
NOISE_ALONE = 2.0  # variance of what is new in a residual against its rough noise, up to which it is noise alone


@dataclass(frozen=True, kw_only=True)
class SensorFilter:
    """A first-order filter of one signal."""

    signal: str
    share: float  # phi: of a sample's noise that was in the sample before
    time_constant: float  # [s]
    digital: bool = False  # it takes samples, as a drive's program does; else it is fitted as a law of the sensor


def coloured_signals(problem: Problem, residuals: Sequence[Mapping[str, Array]]) -> list[SensorFilter]:
    """The signals whose noise looks as if it had passed a filter, with the filter that would have done it.

    `residuals`: (n,) of each run, by signal.
    """
    found = []
    for signal, lag in analog_filters(problem.prior.table).items():
        parts = [(run, left[signal]) for run, left in zip(problem.runs, residuals, strict=True) if signal in left]
        parts = [(run, x) for run, x in parts if _is_sensor_noise(run, signal, x)]
        if not parts or signal in problem.filters or lag.name in problem.prior.effects:
            continue
        share = _estimated_share([run.masked(signal, x) for run, x in parts])
        if share > LEAST:
            share = min(share, MOST)
            step = float(np.median([run.sample_time for run, _ in parts]))
            found.append(SensorFilter(signal=signal, share=share, time_constant=-step / float(np.log(share))))
    return found


def is_noise_alone(problem: Problem, residuals: Sequence[Mapping[str, Array]], seen: SensorFilter) -> bool:
    """Whether errors, (n,) of each run by signal, are noise of this colour and nothing else."""
    parts = [run.masked(seen.signal, r[seen.signal]) for run, r in zip(problem.runs, residuals, strict=True)
             if seen.signal in r]  # fmt: skip
    fresh = [x[1:] - seen.share * x[:-1] for x in parts]
    loud = max(float(np.nanmean(x**2)) / max(noise_from_differences(x) ** 2, 1e-300) for x in fresh)
    return loud < NOISE_ALONE


def _is_sensor_noise(run: Run, signal: str, residual: Array) -> bool:
    """Whether its noise is a sensor's: not that of counts or their difference, and larger than its steps."""
    if signal == "speed" and run.speed_measured.is_difference:
        return False
    return noise_from_differences(residual) > 2.0 * run.quantisation(signal)


def _estimated_share(residuals: Sequence[Array]) -> float:
    """phi of the noise of residuals (n,) each; 0 where it may be white."""
    once, twice = (np.concatenate([_lag_one_correlations(np.diff(x, n)) for x in residuals]) for n in (1, 2))
    if twice.size < 8:
        return 0.0
    shares = np.linspace(0.0, 0.99, 100)
    expected = np.array([_second_difference_correlation(p) for p in shares])
    seen = float(np.median(twice))
    if seen < expected[0] + CERTAIN * 1.25 * float(np.std(twice)) / np.sqrt(twice.size):  # deviation of a median
        return 0.0
    return min(float(np.interp(seen, expected, shares)), 1.0 + 2.0 * float(np.median(once)))


def _lag_one_correlations(x: Array) -> Array:
    """From one sample to the next, of each window of x (n,) that was measured throughout."""
    count = x.size // WINDOW
    windows = x[: count * WINDOW].reshape(count, WINDOW)
    windows = windows[np.isfinite(windows).all(axis=1)]
    energy = np.maximum(np.sum(windows**2, axis=1), 1e-300)
    found: Array = np.sum(windows[:, 1:] * windows[:, :-1], axis=1) / energy * (WINDOW / (WINDOW - 1))
    return found


def _second_difference_correlation(share: float) -> float:
    """Of second differences, from one sample to the next, of an autoregression of first order."""
    c = share ** np.arange(5.0)
    covariance = [6 * c[0] - 8 * c[1] + 2 * c[2], -4 * c[0] + 7 * c[1] - 4 * c[2] + c[3]]
    return float(covariance[1] / covariance[0])
