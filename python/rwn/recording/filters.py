"""First-order filters that a drive or logger runs its samples through: signals as they were, and as it shows them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rwn.recording.clock import clock_of
from rwn.recording.recording import Recording

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


def unfiltered(recording: Recording, filters: Mapping[str, float]) -> Recording:
    """A recording whose signals went through filters of these time constants [s], as they were before.

    A sample that follows a missing one is missing too: what the filter held then is not known.
    """
    passed = {name: tau for name, tau in filters.items() if name in recording.signals}
    if not passed:
        return recording
    signals, missing = dict(recording.signals), dict(recording.missing)
    for name, tau in passed.items():
        signals[name] = before_filter(recording.time, np.asarray(recording.signals[name]), tau)
        if name in missing:
            missing[name] = after_missing(missing[name])
    return replace(recording, signals=signals, missing=missing)


def before_filter(time: Array, shown: Array, time_constant: float) -> Array:
    """The samples (n,) at `time` (n,) [s] from what y += (1 - exp(-T / tau)) (x - y) made of them."""
    kept = _kept(time, time_constant)
    return np.concatenate([shown[:1], (shown[1:] - kept * shown[:-1]) / (1.0 - kept)])


def as_filtered(time: Array, values: Array, time_constant: float) -> Array:
    """What the filter shows of samples (n,) at `time` (n,) [s]; it begins at the first of them."""
    shown = np.array(values)
    for k, kept in enumerate(_kept(time, time_constant), start=1):
        shown[k] = kept * shown[k - 1] + (1.0 - kept) * values[k]
    return shown


def after_missing(missing: Flags) -> Flags:
    """The samples (n,) that are missing, and those after them."""
    after: Flags = missing | np.concatenate([[False], missing[:-1]])
    return after


def _kept(time: Array, time_constant: float) -> Array:
    """Share of what the filter shows that is still in its next sample, (n - 1,).

    A program filters sample by sample, however late each is taken: what counts is the ticks of its clock.
    """
    if time.size < 2:
        return np.zeros(0)
    clock = clock_of(time)
    return np.asarray(np.exp(-clock.period * np.diff(clock.ticks) / time_constant))
