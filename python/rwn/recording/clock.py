"""The clock that rows were sampled by: its period, and the tick of each row."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

IRREGULAR = 1e-3  # jitter that is more than rounded timestamps
FEW = 8  # rows over which the median step counts ticks well enough


@dataclass(frozen=True, kw_only=True)
class Clock:
    """Row k was taken near `start + period * ticks[k]`, `off[k]` periods later; ticks (n,) begin with 0."""

    period: float  # [s]
    start: float  # [s]
    ticks: NDArray[np.int64]
    off: Array

    @property
    def lost(self) -> int:
        """Ticks without a row."""
        return int(self.ticks[-1]) + 1 - self.ticks.size

    @property
    def jitter(self) -> float:
        """Standard deviation of the rows about their ticks, in periods."""
        return float(np.std(self.off))

    @property
    def irregular(self) -> bool:
        """Whether the jitter is more than rounded timestamps."""
        return self.jitter > IRREGULAR


def clock_of(time: Array) -> Clock:
    """The clock of rows at `time` (n,) [s], n at least 2, increasing: the line through the times over their ticks.

    The ticks of twice as many rows are counted by the line through those before: jitter does not add up. Rows that
    share a tick keep no clock: each counts as one.
    """
    usual = float(np.median(np.diff(time)))
    period, start, rows = usual, float(time[0]), FEW
    while True:
        ticks = np.rint((time[:rows] - start) / period)
        if np.any(np.diff(ticks) < 1):
            ticks, period, start, rows = np.arange(time.size), usual, float(time[0]), time.size
            break
        period, start = (float(x) for x in np.polyfit(ticks, time[:rows], 1))
        if rows >= time.size:
            break
        rows *= 2
    off = (time - start) / period - ticks
    return Clock(period=period, start=start + period * ticks[0], ticks=(ticks - ticks[0]).astype(np.int64), off=off)
