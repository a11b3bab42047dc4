"""Checks of a recording before any physics: a check is a file and a line of the registry."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from rwn.recording.inspection.clipping import CLIPPING
from rwn.recording.inspection.converter_steps import without_noise_on_steps
from rwn.recording.inspection.finding import Check, Finding, Flags
from rwn.recording.inspection.held import HELD
from rwn.recording.inspection.hum import without_hum
from rwn.recording.inspection.input_noise import without_input_noise
from rwn.recording.inspection.motion import contradictions
from rwn.recording.inspection.spikes import SPIKES
from rwn.recording.inspection.supply_current import without_supply_current
from rwn.recording.recording import Recording

__all__ = ["CHECKS", "Check", "Finding", "Inspected", "inspected", "without_samples"]

CHECKS: tuple[Check, ...] = (HELD, SPIKES, CLIPPING)


class Inspected(NamedTuple):
    """Recordings with what measures nothing marked as missing, and what was found in them."""

    recordings: list[Recording]
    findings: tuple[Finding, ...]


def inspected(recordings: Sequence[Recording]) -> Inspected:
    """What every check found; samples that measure nothing are not compared with a simulation."""
    made, found = [], []
    for recording in recordings:
        for without in (without_supply_current, without_noise_on_steps):
            recording, said = without(recording)
            found += said
        for check in CHECKS:
            for signal in (s for s in check.signals if s in recording.signals):
                flags = check.flags(recording, signal)
                if flags.any():
                    found.append(check.found(recording, signal, flags))
                    recording = without_samples(recording, signal, flags, bridged=check.bridged)
        recording, hum = without_hum(recording)
        found += hum
        recording, noisy = without_input_noise(recording)
        found += noisy
        found += contradictions(recording)
        made.append(recording)
    return Inspected(made, tuple(found))


def without_samples(recording: Recording, signal: str, lost: Flags, *, bridged: bool = True) -> Recording:
    """The recording with the lost samples marked, and bridged in a line for what follows the recorded motion."""
    missing = lost | recording.missing.get(signal, np.zeros(lost.size, dtype=bool))
    known, values = ~missing, np.array(recording.signals[signal])
    if bridged and known.sum() > 1:
        values[missing] = np.interp(recording.time[missing], recording.time[known], values[known])
    return replace(
        recording,
        signals={**recording.signals, signal: values},
        missing={**recording.missing, signal: missing},
    )
