"""Quantised signals: their step, how well it and the noise let a sample be known, and what rounding adds on average."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rwn.recording.noise import noise_from_differences

Array = NDArray[np.float64]

HARMONICS = 40  # of the mean rounding error
NEAR = 0.1  # of a step, by which a value written with few digits may be off


def quantum(signal: Array) -> float:
    """The step that all values (n,) are multiples of, as encoder counts and their differences are; 0: none.

    A step of 1, 2 or 5 in some decimal is how numbers are written; it counts only where the values repeat.
    """
    if signal.size < 20:
        return 0.0
    values: Array = np.unique(signal - signal[0])
    gaps = np.diff(values)
    if gaps.size < 2:
        return 0.0
    computed = 1e-9 * max(float(np.ptp(values)), 1e-300)  # values nearer to each other differ by how they were computed
    written = NEAR * float(np.percentile(gaps, 75))  # or by how they were written: one on the edge of two last digits
    return max(_step(values[np.append(gaps > least, True)], signal.size) for least in (computed, written))


def _step(values: Array, samples: int) -> float:
    """The step that different `values` (n,), ascending, of a signal of so many samples are multiples of; 0: none."""
    gaps = np.diff(values)
    if gaps.size < 2:
        return 0.0
    step = float(np.median(gaps[gaps < 1.5 * np.percentile(gaps, 5)]))
    values = np.asarray(values[np.argsort(np.abs(values))], dtype=np.float64)
    size = 8
    while True:  # the step is known the better, the further it has been counted
        part = values[:size]
        counts = np.round(part / step)
        step = float(part @ counts / max(float(counts @ counts), 1.0))
        if size >= values.size or step <= 0.0:
            break
        size *= 2
    if step <= 0.0:
        return 0.0
    off = np.abs(values / step - np.round(values / step))
    return step if np.percentile(off, 95) < NEAR and not only_written(step, values.size, samples) else 0.0


def only_written(step: float, different: int, samples: int) -> bool:
    """Whether a step is 1, 2 or 5 in some decimal place, and the `different` of so many samples hardly repeat."""
    return different >= samples / 3 and _decimal(step)


def _decimal(step: float) -> bool:
    """Whether a step is 1, 2 or 5 in some decimal place."""
    leading = step / 10.0 ** np.floor(np.log10(step) + 1e-9)
    return bool(min(abs(leading / m - 1.0) for m in (1.0, 2.0, 5.0, 10.0)) < 1e-4)


def resolution(signal: Array, first: int) -> float:
    """Standard deviation of one of the first samples of a signal (n,): of their noise, or a step of its values."""
    return max(noise_from_differences(signal[:first]), quantum(signal))


def mean_rounding_error(cells: Array, noise: float) -> Array:
    """Mean (n,) of round(x + e) - x for Gaussian noise e, both in steps (Widrow, Kollar 2008, ch. 4)."""
    k = np.arange(1, HARMONICS + 1)
    weights = (-1.0) ** k / (np.pi * k) * np.exp(-2.0 * (np.pi * k * noise) ** 2)
    error: Array = np.sin(2.0 * np.pi * np.multiply.outer(cells, k)) @ weights
    return error
