"""Signals that a logger shows late: as they were in time, and as it shows them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rwn.recording.recording import Recording

Array = NDArray[np.float64]

_ROUNDING = 1e-9  # rounding error of a time [s], beyond which an instant is outside a recording


def in_time(recording: Recording, delays: Mapping[str, float]) -> Recording:
    """A recording whose signals came late by `delays` [s], in step; samples that it no longer holds are missing."""
    late = {name: delay for name, delay in delays.items() if delay and name in recording.signals}
    if not late:
        return recording
    signals, missing = dict(recording.signals), dict(recording.missing)
    for name, delay in late.items():
        at = recording.time + delay
        signals[name] = np.interp(at, recording.time, recording.signals[name])
        without = (at > recording.time[-1] + _ROUNDING) | (at < recording.time[0] - _ROUNDING)
        if name in missing:
            without |= np.interp(at, recording.time, missing[name].astype(np.float64)) > 0.0
        missing[name] = without
    return replace(recording, signals=signals, missing=missing)


def delayed(time: Array, values: Array, delay: float) -> Array:
    """Values (n,) at `time` (n,) [s] as a logger shows them that is late by `delay` [s]."""
    return np.interp(time - delay, time, values) if delay else values
