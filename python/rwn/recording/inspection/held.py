"""Samples that repeat the last one because the sensor had nothing new: sample-and-hold between its own updates."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rwn.recording.inspection.finding import Check, Flags
from rwn.recording.quantisation import quantum
from rwn.recording.recording import Recording

Array = NDArray[np.float64]

OFTEN = 0.3  # share of the samples that have to repeat the last one
AT_ONCE = 0.8  # share of the updates that come after the usual number of samples


def _repeated(recording: Recording, signal: str) -> Flags:
    """Samples that only repeat the last; none where the signal has coarse steps, or stands still by itself."""
    x = np.asarray(recording.signals[signal])
    repeats = np.append(False, np.diff(x) == 0.0)
    none = np.zeros(x.size, dtype=bool)
    if repeats.mean() < OFTEN or repeats.mean() > 0.99:
        return none
    gaps = np.diff(np.flatnonzero(~repeats))
    usual = int(np.median(gaps))
    regular = usual >= 2 and float(np.mean(gaps == usual)) > AT_ONCE
    repeats[2:] |= x[2:] == x[:-2]  # also behind a single spike
    return repeats if regular or (quantum(x) == 0.0 and usual >= 2) else none


def _words(signal: str, repeated: Flags) -> str:
    every = round(float(np.median(np.diff(np.flatnonzero(~repeated)))))  # an update may bring an equal value
    return f"the {signal} is updated every {every} samples and held between"


HELD = Check(kind="held", flags=_repeated, words=_words, done="repeated samples left out", bridged=False)
