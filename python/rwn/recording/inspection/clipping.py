"""A signal that stands exactly at its largest or smallest value: the end of a converter's range."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from rwn.recording.inspection.finding import Finding, Flags
from rwn.recording.noise import rough_noise
from rwn.recording.quantisation import quantum
from rwn.recording.recording import Recording

Array = NDArray[np.float64]

TOGETHER = 5  # samples in a row at the end of the range: of a noise larger than its steps not even three are alike


def find(recording: Recording) -> Iterator[Finding]:
    """Clipped samples of the measured speed and current."""
    for name in ("speed", "current"):
        if name not in recording.signals:
            continue
        clipped = _clipped(np.asarray(recording.signals[name]))
        count = int(clipped.sum())
        if count:
            yield Finding(
                kind="clipping", recording=recording.name, signals=(name,), count=count,
                words=f"{count} samples of the {name} stand at the end of its range",
                done="left out", lost={name: clipped},
            )  # fmt: skip


def _clipped(x: Array) -> Flags:
    flags = np.zeros(x.size, dtype=bool)
    moving = x[np.append(False, np.diff(x) != 0.0)]
    if moving.size < 20 or not rough_noise(moving) > 2.0 * quantum(x):
        return flags  # steps as coarse as the noise repeat by themselves
    for end in (float(np.max(x)), float(np.min(x))):
        at = x == end
        if end != 0.0 and _longest(at) >= TOGETHER:
            flags |= at
    return flags


def _longest(at: Flags) -> int:
    edges = np.flatnonzero(np.diff(np.concatenate([[0], at.astype(int), [0]])))
    return int(np.max(edges[1::2] - edges[::2], initial=0))
