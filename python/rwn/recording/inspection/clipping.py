"""A signal that is exactly at its largest or smallest value again and again: the end of a converter's range."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rwn.recording.inspection.finding import Check, Flags
from rwn.recording.noise import noise_from_differences
from rwn.recording.quantisation import quantum
from rwn.recording.recording import Recording

Array = NDArray[np.float64]

CONVERTED = ("current",)  # signals that a converter of some bits has measured, with 0 at its middle
FEWEST_BITS, MOST_BITS = 6, 16  # of a converter
RARE = 0.02  # most of the rows that are at the end of a converter: a signal that stays there longer has its own
CHANCE = 1e-6  # that so many samples of a noise larger than its steps have the largest value by chance


def _clipped(recording: Recording, signal: str) -> Flags:
    every = np.asarray(recording.signals[signal])
    new = ~recording.missing.get(signal, np.zeros(every.size, dtype=bool))  # held values stand by themselves
    x, found = every[new], np.zeros(every.size, dtype=bool)
    flags = np.zeros(x.size, dtype=bool)
    moving = x[np.append(False, np.diff(x) != 0.0)]
    if moving.size < 20:
        return found
    steps = quantum(x)
    if signal in CONVERTED and steps:
        flags |= _last_codes(x, steps)
    step, noise = steps or float(np.min(np.diff(np.unique(x)))), noise_from_differences(moving)
    if not noise > 2.0 * step:
        found[new] = flags  # steps as coarse as the noise repeat by themselves
        return found
    for end in (float(np.max(x)), float(np.min(x))):
        at = x == end
        alike, near = int(np.sum(at)), int(np.sum(np.abs(x - end) < noise))
        if end != 0.0 and _by_chance(alike, max(near - alike, 1) * step / noise) < CHANCE:
            flags |= at
    found[new] = flags
    return found


def _last_codes(x: Array, step: float) -> Flags:
    """Samples (n,) at the largest or the smallest number of steps that a word of some bits holds, while they are few.

    -128 to 127 for 8 bits; a signal has reached as many as its largest value by chance once in some tens.
    """
    codes = np.round(x / step).astype(np.int64)
    words = 2 ** np.arange(FEWEST_BITS - 1, MOST_BITS)
    ends = [end for end in (int(codes.max()), int(codes.min())) if end in words - 1 or -end in words]
    flags = np.isin(codes, ends)
    return flags if flags.mean() <= RARE else np.zeros(x.size, dtype=bool)


def _by_chance(count: int, expected: float) -> float:
    """Probability that `count` samples are alike, where those beside let so many be `expected` beside the first."""
    from scipy.special import pdtrc  # late: the command line starts without it

    return float(pdtrc(count - 2, expected)) if count > 1 else 1.0


def _words(signal: str, flags: Flags) -> str:
    count = int(flags.sum())
    are = "samples of the {} are" if count > 1 else "sample of the {} is"
    return f"{count} {are.format(signal)} at the end of its range"


CLIPPING = Check(
    kind="clipping",
    flags=_clipped,
    words=_words,
    done="left out",
    signals=("current", "speed"),
)
