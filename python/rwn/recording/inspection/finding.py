"""What a check of a recording found, and what was done about it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

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
    lost: Mapping[str, Flags] = field(default_factory=dict)  # samples (n,) that measure nothing, by signal
