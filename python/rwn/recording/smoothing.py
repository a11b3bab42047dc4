"""Smoothing and slopes of recorded signals: Savitzky-Golay, over as many samples as leaves the motion as it is."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

ORDER = 3
LENGTHS = (31, 21, 15, 11, 7)  # samples; the last is used where the others take too much
UNTOUCHED = 1.2  # what is smoothed away, in units of the noise, up to which it is noise


def smooth(signal: Array, length: int, *, derivative: int = 0, step: float = 1.0) -> Array:
    """The signal (n,) over `length` samples, or its derivative where they are `step` apart.

    With too few samples the signal is left as it is, and its derivatives are 0.
    """
    from scipy.signal import savgol_filter  # late: the command line starts without it

    length = min(length, signal.size - 1 - signal.size % 2)
    if length < ORDER + 2:
        return np.zeros(signal.size) if derivative else signal
    result: Array = savgol_filter(signal, length, ORDER, deriv=derivative, delta=step)
    return result


def smoothing_length(signal: Array, *, resolution: float = 0.0) -> int:
    """The longest of LENGTHS that takes no more off the signal (n,) than its noise, `resolution` (rms) at the least."""
    if signal.size <= LENGTHS[0]:
        return LENGTHS[0]
    noise = max(taken(signal, ORDER + 2), resolution)
    return next((n for n in LENGTHS[:-1] if taken(signal, n) <= UNTOUCHED * noise), LENGTHS[-1])


def taken(signal: Array, length: int) -> float:
    """The white noise (rms) that would explain what smoothing over `length` samples takes off a signal (n,)."""
    from scipy.signal import savgol_coeffs

    left = 1.0 - float(savgol_coeffs(length, ORDER)[length // 2])
    return float(np.sqrt(np.mean((signal - smooth(signal, length)) ** 2) / left))


def noise_gain(length: int, *, derivative: int, step: float) -> float:
    """White noise (rms) of a derivative over `length` samples, of a signal of unit noise with samples `step` apart."""
    from scipy.signal import savgol_coeffs

    return float(np.linalg.norm(savgol_coeffs(length, ORDER, deriv=derivative, delta=step)))
