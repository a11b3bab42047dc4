"""When the samples of a recording were taken: the usual step, its jitter and rows that were lost."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

LATE = 1.5  # steps above which a row is missing before this one
IRREGULAR = 1e-3  # relative deviation of the sample time that is more than rounded timestamps


@dataclass(frozen=True, kw_only=True)
class Clock:
    """`step`: median sample time [s]; `jitter`: its relative deviation; `lost`: rows that are missing."""

    step: float
    jitter: float
    lost: int

    @property
    def irregular(self) -> bool:
        """Whether the jitter is more than rounded timestamps."""
        return self.jitter > IRREGULAR


def clock(time: Array) -> Clock:
    """The clock of instants (n,) [s]."""
    steps = np.diff(time)
    usual = float(np.median(steps))
    late = steps > LATE * usual
    return Clock(
        step=usual,
        jitter=float(np.std(steps[~late])) / usual,
        lost=int(np.sum(np.round(steps[late] / usual) - 1)),
    )
