"""Faults of the recordings themselves, the commonest mismatch: unit, sign, gear ratio, channels out of step."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import reduce
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rwn.fit.intervals import Estimate
from rwn.name.found_effect import FoundEffect
from rwn.recording.layout import Column, Layout
from rwn.recording.noise import Noise
from rwn.recording.recording import Recording
from rwn.recording.signals import MEASURED

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

RECORDING = "recording"  # the equation of a fault in the recordings
UNIT = "wrong-unit"
SIGN = "wrong-sign"
GEAR = "wrong-gear-ratio"
SHIFT = "time-shift"
LINE = 4  # samples
SURE = 0.99  # probability that is stated of a fault; those that fit alike share it


class ErrorReduction(NamedTuple):
    """How much squared error above the noise vanishes when a fault is undone, with the effects that are found then."""

    share: float  # of what the refitted model leaves
    part: float  # of what the best physics leaves that does without it


@dataclass(frozen=True, kw_only=True)
class Fault:
    """recorded(t) = factor * true(t - delay) for each of `signals`."""

    name: str  # UNIT | SIGN | GEAR | SHIFT
    signals: tuple[str, ...]
    meaning: str
    factor: float = 1.0
    spread: float = 0.0  # relative standard deviation of the factor
    delay: int = 0  # samples by which the signals come late
    step: float = 0.0  # sample time [s]
    also: tuple[str, ...] = ()  # other faults that these recordings do not tell from it
    removes: ErrorReduction | None = None  # None: a scale that is plainly wrong
    recordings: tuple[str, ...] = ()  # those that have it, by `known_as`; none: all

    def undo(self, recording: Recording) -> Recording:
        """The recording as it should have been; where a signal came late, all are cut to what is left.

        Where one came early, what it was before its first sample is not known: the run begins where the input does.
        """
        if self.recordings and known_as(recording) not in self.recordings:
            return recording
        n = len(recording) - max(self.delay, 0)
        signals = {name: np.array(values[:n]) for name, values in recording.signals.items()}
        moved = [name for name in self.signals if name in signals]
        for name in moved:
            signals[name] = _moved_values(np.array(recording.signals[name]), self.delay)[:n] / self.factor
        missing = {s: lost[:n] for s, lost in recording.missing.items()}
        for name in moved:
            lost = _moved(recording.missing.get(name, np.zeros(len(recording), dtype=bool)), self.delay)[:n]
            if lost.any():
                missing[name] = lost
        # what was read off the input as it stood holds no longer where the input is moved
        applied = recording.applied_input if set(moved) <= set(MEASURED) else None
        return replace(recording, time=recording.time[:n], signals=signals, missing=missing, applied_input=applied)

    def in_layout(self, layout: Layout) -> Layout:
        """The layout of recordings that all have it: their delays, and what each signal is multiplied by."""
        if self.recordings:
            return layout
        late = [s for s in self.signals if self.delay and s in MEASURED]
        delays = {s: layout.delays.get(s, 0.0) + self.delay * self.step for s in late}
        scaled = self.signals if self.factor != 1.0 else ()
        known = {s: layout.columns.get(s, Column(source=s)) for s in scaled}
        columns = {s: replace(column, scale=column.scale / self.factor) for s, column in known.items()}
        return replace(layout, delays={**layout.delays, **delays}, columns={**layout.columns, **columns})

    def noise_without(self, noise: Mapping[str, Noise]) -> dict[str, Noise]:
        """The noise of the signals once it is undone."""
        return {s: n.scaled(1.0 / self.factor) if s in self.signals else n for s, n in noise.items()}

    def found(self, probability: float = SURE) -> FoundEffect:
        """How a diagnosis reports it; `probability`: that it or one that these recordings do not tell from it is so."""
        parameters = {}
        if self.factor not in (1.0, -1.0):
            low, high = sorted(self.factor * (1.0 + times * self.spread) for times in (-1.96, 1.96))
            interval = (low, high) if self.spread > 0.0 else None
            parameters["factor"] = Estimate(value=self.factor, unit="1", interval=interval)
        if self.delay:
            parameters["shift"] = Estimate(value=self.delay * self.step, unit="s")
        return FoundEffect(
            name=self.name, equation=RECORDING, parameters=parameters,
            probability=min(SURE, probability) / (1 + len(self.also)),
            meaning=self.meaning, signals=self.signals, recordings=self.recordings,
        )  # fmt: skip


def known_as(recording: Recording) -> str:
    """What tells a recording from others: two files in different folders may have one name."""
    return recording.source or recording.name


def without(recordings: Sequence[Recording], fault: Fault) -> list[Recording]:
    """The recordings as they should have been."""
    return [fault.undo(r) for r in recordings]


def without_all(recordings: Sequence[Recording], faults: Iterable[Fault]) -> list[Recording]:
    """The recordings as they should have been without several faults, undone one after the other."""
    return reduce(without, faults, list(recordings))


def _moved_values(values: Array, delay: int) -> Array:
    if delay < 0:
        return np.concatenate([_before(values, -delay), values[:delay]])
    return values[delay:]


def _moved(lost: Flags, delay: int) -> Flags:
    """Which samples (n,) are missing once a signal is moved; those from before its first sample are, too."""
    if delay < 0:
        return np.concatenate([np.full(-delay, True), lost[:delay]])
    return lost[delay:]


def _before(values: Array, samples: int) -> Array:
    """A guess at the samples before the first: along the line through as many that follow, and some more."""
    count = min(samples + LINE, values.size)
    slope, first = np.polyfit(np.arange(count), values[:count], 1)
    before: Array = first + slope * np.arange(-samples, 0)
    return before
