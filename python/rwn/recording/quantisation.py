"""Quantised signals: their step, how well it and the noise let a sample be known, and what rounding adds on average."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rwn.recording.noise import PER_MEDIAN, noise_from_differences

Array = NDArray[np.float64]

HARMONICS = 40  # of the mean rounding error
NEAR = 0.1  # of a step, by which a value written with few digits may be off
FEWEST = 100  # samples in which steps are sought beneath noise
FEWEST_STEPS, MOST_STEPS = 8, 400  # of a range; finer ones are noise
BINS = 8  # of a histogram, in the finest steps
FINER = 4  # frequencies in the width of a line
REFINED = 5  # times that steps are fitted to the values near them
RARE = 0.005  # share of the samples at either end that may be spikes
SURELY = 4.0  # deviations of normal numbers beyond which hardly one lies
LEVEL = 0.001  # chance of steps in a signal without them


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
    repeats = values.size < samples / 3
    return step if np.percentile(off, 95) < NEAR and (repeats or not _decimal(step)) else 0.0


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


@dataclass(frozen=True, kw_only=True)
class NoisySteps:
    """Steps that values lie near."""

    step: float
    offset: float
    noise: float  # standard deviation of the values beside them

    def nearest(self, signal: Array) -> Array:
        """The step (n,) that each value of a signal (n,) is nearest to."""
        steps: Array = self.offset + self.step * np.round((signal - self.offset) / self.step)
        return steps

    def holds(self, signal: Array) -> NDArray[np.bool_]:
        """Whether each value of a signal (n,) is as near to a step as the noise lets it be."""
        return np.asarray(np.abs(signal - self.nearest(signal)) <= SURELY * self.noise)


def noisy_steps(signal: Array) -> NoisySteps | None:
    """The steps of a converter in a signal (n,) to which noise came behind it; None where there are none.

    They are found by the characteristic function of the values, which is near 1 at the steps' frequency, and near 0
    for a signal that goes through all values (Widrow, Kollar 2008, ch. 4). Each step counts once in it, since a signal
    may come back to a level often.
    """
    if signal.size < FEWEST or quantum(signal) > 0.0:
        return None
    low, high = np.percentile(signal, (100.0 * RARE, 100.0 * (1.0 - RARE)))
    if not high > low:
        return None
    step = (high - low) / _clearest_frequency((signal - low) / (high - low))
    offset, noise = 0.0, 0.0
    for _ in range(REFINED):
        cells = np.round((signal - offset) / step)
        off = signal - offset - step * cells
        near = np.abs(off) <= np.median(np.abs(off)) * PER_MEDIAN * SURELY
        if np.unique(cells[near]).size < 2:
            return None
        step, offset = (float(c) for c in np.polyfit(cells[near], signal[near], 1))
        noise = float(PER_MEDIAN * np.median(np.abs(off)))
    found = NoisySteps(step=step, offset=offset, noise=noise)
    repeats = np.unique(cells).size < signal.size / 3
    clear = SURELY * noise < 0.5 * step and np.mean(found.holds(signal)) > 0.5 and (repeats or not _decimal(step))
    return found if clear and _chance(signal, found) < LEVEL else None


def _clearest_frequency(signal: Array) -> float:
    """Steps over the range [0, 1] of a signal (n,) at which its values lie nearest to multiples."""
    bins = BINS * MOST_STEPS
    counts, _ = np.histogram(np.clip(signal, 0.0, 1.0), bins=bins, range=(0.0, 1.0))
    clearness = np.abs(np.fft.rfft(counts, FINER * bins))
    frequencies = np.arange(clearness.size) / FINER
    asked = (frequencies >= FEWEST_STEPS) & (frequencies <= MOST_STEPS)
    return float(frequencies[asked][np.argmax(clearness[asked])])


def _chance(signal: Array, steps: NoisySteps) -> float:
    """That a signal without steps seems to have these: if each level that it came to lay anywhere, by itself."""
    came = np.abs(np.diff(signal, prepend=np.inf)) > 0.5 * steps.step
    cells = np.round((signal[came] - steps.offset) / steps.step)
    turned = np.exp(2j * np.pi * (signal[came] - steps.offset) / steps.step)
    _, of = np.unique(cells, return_inverse=True)
    each = np.bincount(of, turned.real) / np.bincount(of) + 1j * np.bincount(of, turned.imag) / np.bincount(of)
    return float(MOST_STEPS * np.exp(-each.size * np.abs(np.mean(each)) ** 2))
