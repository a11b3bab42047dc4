"""Checks of a recording before any physics: a check is a file and a line of the registry."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from rwn.recording.inspection import clipping, held, spikes
from rwn.recording.inspection.finding import Finding
from rwn.recording.recording import Recording

Check = Callable[[Recording], Iterable[Finding]]

__all__ = ["CHECKS", "Finding", "Inspected", "inspected"]

CHECKS: tuple[Check, ...] = (
    held.find,
    spikes.find,
    clipping.find,
)


class Inspected(NamedTuple):
    """Recordings with what measures nothing marked as missing, and what was found in them."""

    recordings: list[Recording]
    findings: tuple[Finding, ...]


def inspected(recordings: Sequence[Recording]) -> Inspected:
    """What every check found; samples that measure nothing are not compared with a simulation."""
    made, found = [], []
    for recording in recordings:
        for check in CHECKS:
            here = list(check(recording))
            found += here
            for finding in here:
                recording = _without(recording, finding)
        made.append(recording)
    return Inspected(made, tuple(found))


def _without(recording: Recording, finding: Finding) -> Recording:
    """The recording with the lost samples marked, and bridged in a line for what follows the recorded motion."""
    signals, missing = dict(recording.signals), dict(recording.missing)
    for name, lost in finding.lost.items():
        missing[name] = lost | missing.get(name, np.zeros(lost.size, dtype=bool))
        known = ~missing[name]
        values = np.array(signals[name])
        if finding.kind != "held" and known.sum() > 1:
            values[~known] = np.interp(recording.time[~known], recording.time[known], values[known])
        signals[name] = values
    return replace(recording, signals=signals, missing=missing)
