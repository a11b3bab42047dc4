"""A signal that stands exactly at its largest or smallest value: the end of a converter's range."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rwn.recording.inspection.finding import Check, Flags
from rwn.recording.noise import noise_from_differences
from rwn.recording.quantisation import quantum
from rwn.recording.recording import Recording

Array = NDArray[np.float64]

TOGETHER = 5  # samples in a row at the end of the range: of a noise larger than its steps not even three are alike


def _clipped(recording: Recording, signal: str) -> Flags:
    every = np.asarray(recording.signals[signal])
    new = ~recording.missing.get(signal, np.zeros(every.size, dtype=bool))  # held values stand by themselves
    x, found = every[new], np.zeros(every.size, dtype=bool)
    flags = np.zeros(x.size, dtype=bool)
    moving = x[np.append(False, np.diff(x) != 0.0)]
    if moving.size < 20 or not noise_from_differences(moving) > 2.0 * quantum(x):
        return found  # steps as coarse as the noise repeat by themselves
    for end in (float(np.max(x)), float(np.min(x))):
        at = x == end
        if end != 0.0 and _longest(at) >= TOGETHER:
            flags |= at
    found[new] = flags
    return found


def _longest(at: Flags) -> int:
    edges = np.flatnonzero(np.diff(np.concatenate([[0], at.astype(int), [0]])))
    return int(np.max(edges[1::2] - edges[::2], initial=0))


CLIPPING = Check(
    kind="clipping",
    flags=_clipped,
    words=lambda signal, flags: f"{int(flags.sum())} samples of the {signal} stand at the end of its range",
    done="left out",
    signals=("current", "speed"),
)
