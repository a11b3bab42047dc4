"""A signal that is exactly at its largest or smallest value again and again: the end of a converter's range."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rwn.recording.inspection.finding import Check, Flags
from rwn.recording.noise import noise_from_differences
from rwn.recording.quantisation import quantum
from rwn.recording.recording import Recording

Array = NDArray[np.float64]

CHANCE = 1e-6  # that so many samples of a noise larger than its steps have the largest value by chance


def _clipped(recording: Recording, signal: str) -> Flags:
    every = np.asarray(recording.signals[signal])
    new = ~recording.missing.get(signal, np.zeros(every.size, dtype=bool))  # held values stand by themselves
    x, found = every[new], np.zeros(every.size, dtype=bool)
    flags = np.zeros(x.size, dtype=bool)
    moving = x[np.append(False, np.diff(x) != 0.0)]
    if moving.size < 20:
        return found
    step, noise = quantum(x) or float(np.min(np.diff(np.unique(x)))), noise_from_differences(moving)
    if not noise > 2.0 * step:
        return found  # steps as coarse as the noise repeat by themselves
    for end in (float(np.max(x)), float(np.min(x))):
        at = x == end
        alike, near = int(np.sum(at)), int(np.sum(np.abs(x - end) < noise))
        if end != 0.0 and _by_chance(alike, max(near - alike, 1) * step / noise) < CHANCE:
            flags |= at
    found[new] = flags
    return found


def _by_chance(count: int, expected: float) -> float:
    """Probability that `count` samples are alike, where those beside let so many be `expected` beside the first."""
    from scipy.special import pdtrc  # late: the command line starts without it

    return float(pdtrc(count - 2, expected)) if count > 1 else 1.0


CLIPPING = Check(
    kind="clipping",
    flags=_clipped,
    words=lambda signal, flags: f"{int(flags.sum())} samples of the {signal} are at the end of its range",
    done="left out",
    signals=("current", "speed"),
)
