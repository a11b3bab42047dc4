"""What a check of a recording is, and what it found."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rwn.recording.recording import Recording
from rwn.recording.signals import MEASURED

Flags = NDArray[np.bool_]


@dataclass(frozen=True, kw_only=True)
class Finding:
    """One thing that is odd in a recording."""

    kind: str  # name of the check: "spikes"
    recording: str
    signals: tuple[str, ...]
    count: int  # samples
    words: str  # what was found, for people
    done: str = ""  # what was done about it
    quantity: str = ""  # what differs between the recordings that were fitted
    held: str = ""  # whose of it the corrected model holds: "that of run1.csv", "the mean"


@dataclass(frozen=True, kw_only=True)
class Check:
    """A check of one measured signal after another: which samples (n,) measure nothing, and how that is said."""

    kind: str
    flags: Callable[[Recording, str], Flags]
    words: Callable[[str, Flags], str]
    done: str
    signals: tuple[str, ...] = MEASURED
    bridged: bool = True  # the samples stand for nothing: what follows the recorded motion takes a line in their place

    def found(self, recording: Recording, signal: str, flags: Flags) -> Finding:
        """What the flagged samples of a signal are called."""
        return Finding(
            kind=self.kind, recording=recording.name, signals=(signal,), count=int(flags.sum()),
            words=self.words(signal, flags), done=self.done,
        )  # fmt: skip
