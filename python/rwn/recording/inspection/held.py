"""Samples that repeat the last one because the sensor had nothing new: sample-and-hold between its own updates."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from rwn.recording.inspection.finding import Finding, Flags
from rwn.recording.quantisation import quantum
from rwn.recording.recording import Recording

Array = NDArray[np.float64]

OFTEN = 0.3  # share of the samples that have to repeat the last one
AT_ONCE = 0.8  # share of the updates that come after the usual number of samples


def find(recording: Recording) -> Iterator[Finding]:
    """Signals that are updated every few samples only."""
    for name in ("speed", "current", "position"):
        if name not in recording.signals:
            continue
        repeated = _repeated(np.asarray(recording.signals[name]))
        count = int(repeated.sum())
        if count:
            every = round(repeated.size / (repeated.size - count))
            yield Finding(
                kind="held", recording=recording.name, signals=(name,), count=count,
                words=f"the {name} is updated every {every} samples and held between",
                done="repeated samples left out", lost={name: repeated},
            )  # fmt: skip


def _repeated(x: Array) -> Flags:
    """Samples that only repeat the last; none where the signal has coarse steps, or stands still by itself."""
    repeats = np.append(False, np.diff(x) == 0.0)
    none = np.zeros(x.size, dtype=bool)
    if repeats.mean() < OFTEN or repeats.mean() > 0.99:
        return none
    gaps = np.diff(np.flatnonzero(~repeats))
    usual = int(np.median(gaps))
    regular = usual >= 2 and float(np.mean(gaps == usual)) > AT_ONCE
    return repeats if regular or (quantum(x) == 0.0 and usual >= 2) else none
