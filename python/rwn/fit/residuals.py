"""How strongly recordings speak for one explanation against another when their residuals are coloured."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rwn.fit.fit import Fitted
from rwn.fit.problem import OutputError

Array = NDArray[np.float64]

AT_THE_FLOOR = 1.4  # coloured energy of a residual that may still be measurement noise
RINGING = 3.0  # energy of a residual's loudest band that may still be that of noise: differences of counts have 2,
LOUD = 1.3  # where the residual has at least so much variance in units of the noise
MISSPECIFIED = 50.0  # most independent samples that a residual with physics left in it is worth


@dataclass(frozen=True, kw_only=True)
class Statistics:
    """What is left of a fit."""

    count: int  # samples
    variance: float  # mean squared weighted error; 1: the noise alone
    correlation_time: float  # integrated autocorrelation time, in samples; 1: white
    coloured: float  # energy of block means against that of white noise; 1: white
    ringing: float = 1.0  # energy of the loudest band of frequencies against that of white noise; 1: white

    @property
    def at_the_floor(self) -> bool:
        """Whether the residual may be measurement noise alone: it is not slow, nor loud and of one pitch."""
        rings = self.ringing >= RINGING and self.variance >= LOUD
        return (self.coloured < AT_THE_FLOOR and not rings) or self.variance < 1.05

    @property
    def effective(self) -> float:
        """Effective number of independent samples."""
        return self.count / self.correlation_time


def correlation_time(x: Array) -> float:
    """Integrated autocorrelation time 1 + 2 sum rho_k in samples (Sokal's window of 5 times itself), at least 1."""
    x = x[np.isfinite(x)] - np.nanmean(x)
    n = x.size
    if n < 8 or not np.any(x):
        return 1.0
    size = 1 << (2 * n - 1).bit_length()  # a length with a large prime factor takes ten times as long
    rho = np.fft.irfft(_power(np.fft.rfft(x, size)))[:n]
    sums = 2.0 * np.cumsum(rho / rho[0]) - 1.0
    inside = np.nonzero(np.arange(n) >= 5.0 * sums)[0]
    return float(max(1.0, sums[inside[0] if inside.size else n - 1]))


def coloured_share(x: Array, blocks: Sequence[int] = (8, 32, 128)) -> float:
    """Largest of m var(mean of m samples) / var(x) over block lengths m: 1 for white noise."""
    x = x[np.isfinite(x)]
    variance = float(np.mean(x**2))
    found = [1.0]
    for m in blocks:
        k = x.size // m
        if k >= 8 and variance > 0.0:
            found.append(m * float(np.mean(x[: k * m].reshape(k, m).mean(axis=1) ** 2)) / variance)
    return max(found)


def ringing_share(x: Array, length: int = 32) -> float:
    """Largest density of the spectrum (Welch, segments of `length` samples) against its mean: 1 for white noise.

    A shaft that swings leaves means of zero, which `coloured_share` takes for noise.
    """
    x = x[np.isfinite(x)]
    if x.size < 8 * length or not np.any(x):
        return 1.0
    # scipy's welch takes 30 times as long
    segments = np.lib.stride_tricks.sliding_window_view(x, length)[:: length // 2]
    density = np.mean(_power(np.fft.rfft(segments * np.hanning(length + 1)[:-1])), axis=0)[1:-1]
    return float(np.max(density) / np.mean(density))


def _power(spectrum: NDArray[np.complex128]) -> Array:
    power: Array = spectrum.real**2 + spectrum.imag**2
    return power


def statistics(problem: OutputError, fitted: Fitted, *, drift: bool = True) -> Statistics:
    """Residual statistics of a fit, over all recordings and signals.

    `drift`: with the position's beside those of other signals; its noise level is the slow error that it is left.
    """
    joined = join(problem, problem.residuals(fitted.vector, fitted.candidate.active))
    if not drift and len(joined) > 1:
        joined.pop("position", None)
    return statistics_of(joined)


def variance(problem: OutputError, fitted: Fitted) -> float:
    """Mean squared weighted error of a fit, over all recordings and signals; 1: the noise alone."""
    joined = join(problem, problem.residuals(fitted.vector, fitted.candidate.active))
    return sum(_energies(joined).values()) / max(_count(joined), 1)


def statistics_of(joined: Mapping[str, Array]) -> Statistics:
    """Statistics of weighted residuals by signal."""
    energies, count = _energies(joined), _count(joined)
    whole = sum(energies.values())
    correlated = sum(energies[s] * correlation_time(r) for s, r in joined.items())
    return Statistics(
        count=count,
        variance=whole / max(count, 1),
        correlation_time=max(1.0, correlated / whole) if whole else 1.0,
        coloured=max(coloured_share(r) for r in joined.values()),
        ringing=max(ringing_share(r) for r in joined.values()),
    )


def _energies(joined: Mapping[str, Array]) -> dict[str, float]:
    return {s: float(np.nansum(r**2)) for s, r in joined.items()}


def _count(joined: Mapping[str, Array]) -> int:
    return sum(int(np.isfinite(r).sum()) for r in joined.values())


def join(problem: OutputError, residuals: Sequence[Mapping[str, Array]]) -> dict[str, Array]:
    """Weighted residuals of each signal, recordings end to end."""
    signals = {s for r in residuals for s in r}
    return {
        s: np.concatenate([r[s] for r in residuals if s in r]) / problem.noise.get(s, 1.0)
        for s in sorted(signals)
    }


@dataclass(frozen=True, kw_only=True)
class Hypothesis:
    """An explanation with its probability among those that were tried."""

    fitted: Fitted
    final: Fitted  # what is drawn and saved: `fitted`, or the same refitted under coloured noise
    score: float  # log of evidence, up to a constant
    probability: float
    misfit: float  # log-likelihood lost against the best, complexity aside


def weigh(
    fits: Sequence[Fitted], left: Statistics, *, rivals: int, prior: Mapping[str, float] | None = None,
    finals: Sequence[Fitted] | None = None,
) -> list[Hypothesis]:  # fmt: skip
    """Probabilities of the fits, best first.

    BIC with the effective number of samples of the best explanation's residual (coloured residuals carry less), a
    uniform prior over how many effects are missing, shared over the `rivals` names. `prior`: log prior odds per name.
    `finals`: what the fits became under coloured noise, to be weighed in their place.
    """
    finals = fits if finals is None else finals
    effective = left.effective if left.at_the_floor else min(left.effective, MISSPECIFIED)
    scale = 2.0 * max(left.variance, 1.0) * left.count / max(effective, 2.0)
    least = min(f.cost for f in finals)
    base = min(map(_seen, finals))
    scores = []
    for f in finals:
        unknowns = _seen(f) - base
        names = sum((prior or {}).get(name, 0.0) for name in f.added)
        scores.append(
            -(f.cost - least) / scale
            - 0.5 * unknowns * np.log(max(effective, 2.0))
            - len(f.added) * np.log(rivals)
            + names
        )
    weights = np.exp(np.array(scores) - max(scores))
    weights /= weights.sum()
    rows = [
        Hypothesis(fitted=f, final=g, score=float(s), probability=float(p), misfit=float((g.cost - least) / scale))
        for f, g, s, p in zip(fits, finals, scores, weights, strict=True)
    ]
    return sorted(rows, key=lambda h: -h.score)


def _seen(fitted: Fitted) -> int:
    """How many unknowns the recordings depend on: the offset of a current that nobody recorded is not one."""
    return int(np.count_nonzero(np.diag(fitted.minimum.data_information)))
