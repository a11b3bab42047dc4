"""The noise of a sensor beside what a model leaves out, told apart by their spectra.

Noise that a filter y_k = phi y_{k-1} + (1 - phi) x_k has passed is level towards half the sampling rate, while what a
model leaves out falls off steeply: it is a motion. Of the periodograms of short windows a low quantile is taken at each
frequency, since it is of the windows where little is missing; Whittle's likelihood of

    S(w) = s (1 - phi)^2 / |1 - phi e^{-iw}|^2  +  m (2 sin(w / 2))^-p

then tells phi and how certain it is, over whatever p the missing motion may have.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from rwn.recording.spectral_lines import without_lines

Array = NDArray[np.float64]

WINDOWS = (32, 64)  # samples: the shorter are freer of steps of the input, the longer tell more slopes apart
QUIET = 0.3  # quantile of the windows that is taken: in three of ten little is missing
LOWEST = 3  # first frequency that counts: the trend taken off and the taper have changed those below
BANDWIDTH = 1.5  # of a Hann taper, in frequencies: so many estimates beside each other are one
FASTEST = 0.1  # of phi: a filter faster than half a sample changes nothing
SLOPES = np.array([2.0, 3.0, 4.0, 6.0, 8.0])  # p: of a jump, of a bend and of what is smoother
SHARES = np.linspace(0.0, 0.98, 50)  # phi
STEPS = 100  # of the levels s and m towards their likeliest values: they are known to a per cent by then


@dataclass(frozen=True, kw_only=True)
class NoiseColour:
    """What the noise shows of a filter."""

    share: float = 0.0  # phi: of a sample's noise that was in the sample before
    deviation: float = np.inf  # standard deviation of it
    evidence: float = 0.0  # log likelihood against white noise
    filtered: float = 0.0  # probability that phi is above FASTEST

    def log_likelihood(self, share: float) -> float:
        """How likely the noise is with another phi than it shows; 0: with no filter."""
        return -0.5 * ((share - self.share) / self.deviation) ** 2 if share else -self.evidence


def noise_colour(residuals: Sequence[Array]) -> NoiseColour:
    """What the noise of residuals (n,) each shows; samples that are left out are NaN.

    What is missing may mislead windows of one length: what is said is the mean of what those of either length say.
    Lines, as the ripple of a bridge makes one, went through the filter too and tell nothing of it: they are taken off.
    """
    residuals = [without_lines(x) for x in residuals]
    told = [one for window in WINDOWS if (one := _probabilities(residuals, window)) is not None]
    if not told:
        return NoiseColour()
    of_share: Array = np.mean(told, axis=0)
    share = float(of_share @ SHARES)
    variance = float(of_share @ (SHARES - share) ** 2) + (SHARES[1] - SHARES[0]) ** 2 / 12.0
    return NoiseColour(
        share=share,
        deviation=float(np.sqrt(variance)),
        evidence=float(np.log(of_share.max() / max(of_share[0], 1e-300))),
        filtered=float(of_share[SHARES > FASTEST].sum()),
    )


def _probabilities(residuals: Sequence[Array], window: int) -> Array | None:
    """Of each of SHARES, by windows of so many samples; None: there are too few."""
    windows = _periodograms(residuals, window)
    if windows.shape[0] < 2:
        return None
    seen = np.quantile(windows, QUIET, axis=0) / -np.log(1.0 - QUIET)
    if not np.all(seen > 0.0):
        return None
    # variance of a quantile of exponentials; windows overlap by half
    count = windows.shape[0] / BANDWIDTH * (1.0 - QUIET) * np.log(1.0 - QUIET) ** 2 / QUIET / BANDWIDTH
    likelihood = count * _log_likelihoods(seen, window)
    weights = np.exp(likelihood - likelihood.max()).sum(axis=1)
    found: Array = weights / weights.sum()
    return found


def _periodograms(residuals: Sequence[Array], window: int) -> Array:
    """Power (windows, frequencies) of each window that was measured throughout, half of which is in the next."""
    taper = np.hanning(window + 2)[1:-1]
    line = np.linspace(-1.0, 1.0, window)
    found = [np.empty((0, window // 2 - LOWEST))]
    for x in residuals:
        if x.size < window:
            continue
        windows = sliding_window_view(x, window)[:: window // 2]
        windows = windows[np.isfinite(windows).all(axis=1)]
        level = windows - windows.mean(axis=1, keepdims=True)
        level = level - np.outer(level @ line / (line @ line), line)
        found.append(np.abs(np.fft.rfft(level * taper, axis=1)[:, LOWEST:-1]) ** 2 / (taper @ taper))
    return np.concatenate(found)


def _log_likelihoods(seen: Array, window: int) -> Array:
    """Whittle's (SHARES, SLOPES) of one window with the power `seen`, at the likeliest levels."""
    noise, motion = _shapes(window)
    s = np.full((SHARES.size, SLOPES.size, 1), seen[seen.size // 2 :].mean())
    m = np.full_like(s, 0.3 * seen[0] / motion[0, -1, 0])
    for _ in range(STEPS):  # each multiplied by the root of the ratio of the gradient's two parts: stays positive
        both = s * noise + m * motion
        towards, away = seen / both**2, 1.0 / both
        s = s * np.sqrt((noise * towards).sum(-1, keepdims=True) / (noise * away).sum(-1, keepdims=True))
        m = m * np.sqrt((motion * towards).sum(-1, keepdims=True) / (motion * away).sum(-1, keepdims=True))
    both = s * noise + m * motion
    found: Array = -(np.log(both) + seen / both).sum(-1)
    return found


@cache
def _shapes(window: int) -> tuple[Array, Array]:
    """Spectra of filtered noise (SHARES, 1, frequencies) and of a motion (1, SLOPES, frequencies)."""
    w = np.linspace(0.0, np.pi, window // 2 + 1)[LOWEST:-1]
    noise = (1.0 - SHARES[:, None]) ** 2 / np.abs(1.0 - SHARES[:, None] * np.exp(-1j * w)) ** 2
    motion = (2.0 * np.sin(w / 2.0)) ** -SLOPES[:, None]
    return noise[:, None], motion[None]
