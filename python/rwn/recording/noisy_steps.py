"""The steps of a converter in a signal to which noise came behind it, so that no value is a multiple of them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rwn.recording.noise import PER_MEDIAN
from rwn.recording.quantisation import only_written, quantum

Array = NDArray[np.float64]

FEWEST = 100  # samples in which steps are sought
FEWEST_STEPS, MOST_STEPS = 8, 400  # of a range; finer ones are noise
BINS = 8  # of a histogram, in the finest steps
FINER = 4  # frequencies in the width of a line
REFINED = 5  # times that steps are fitted to the values near them
RARE = 0.005  # share of the samples at either end that may be spikes
SURELY = 4.0  # deviations of normal numbers beyond which hardly one lies
LEVEL = 0.001  # chance of steps in a signal without them


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
    clear = SURELY * noise < 0.5 * step and np.mean(found.holds(signal)) > 0.5
    if not clear or only_written(step, np.unique(cells).size, signal.size):
        return None
    return found if _chance(signal, found) < LEVEL else None


def _clearest_frequency(signal: Array) -> float:
    """Steps over the range [0, 1] of a signal (n,) at which its values lie nearest to multiples."""
    bins = BINS * MOST_STEPS
    counts, _ = np.histogram(np.clip(signal, 0.0, 1.0), bins=bins, range=(0.0, 1.0))
    clearness = np.abs(np.fft.rfft(counts, FINER * bins))
    frequencies = np.arange(clearness.size) / FINER
    asked = (frequencies >= FEWEST_STEPS) & (frequencies <= MOST_STEPS)
    return float(frequencies[asked][np.argmax(clearness[asked])])


def _chance(signal: Array, steps: NoisySteps) -> float:
    """That a signal without steps seems to have these: if each level that it came to lay anywhere, by itself.

    One that moves at a steady pace comes to levels that are equally far apart without any steps: only one at which it
    stayed, with a value that is new, or from which it went back, counts.
    """
    new = signal[np.diff(signal, prepend=np.inf) != 0.0]
    turns = (new - steps.offset) / steps.step
    moved = np.round(np.diff(turns, prepend=turns[0]))
    came = (moved != 0.0) & (moved * np.append(moved[1:], 0.0) <= 0.0)
    if not came.any():
        return 1.0
    cells, turned = np.round(turns[came]), np.exp(2j * np.pi * turns[came])
    _, of = np.unique(cells, return_inverse=True)
    each = np.bincount(of, turned.real) / np.bincount(of) + 1j * np.bincount(of, turned.imag) / np.bincount(of)
    return float(MOST_STEPS * np.exp(-each.size * np.abs(np.mean(each)) ** 2))
