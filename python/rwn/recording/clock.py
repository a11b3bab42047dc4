"""The clock that rows were sampled by: its period, and the tick of each row."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from heapq import heappush, heapreplace

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

LOST_ROW = 1.5  # median intervals between two rows, from which on one is missing between them
IRREGULAR = 1e-3  # jitter that is more than rounded timestamps
FIRST = 512  # rows that show a clock beside which they lie up to 0.4 periods off
SEARCHED = 4.0  # deviations of the median step of the first rows, within which the period is looked for
LOST = 0.05  # of the rows, at most, where their times are rounded
FARTHEST = 0.3  # relative distance from the median step beyond which most steps would skip a tick
PER_CYCLE = 4  # periods that are tried for each cycle by which they differ over the rows
AS_WELL = 1.0 / float(np.sinc(0.5 / PER_CYCLE))  # agreement at a period over that at the nearest that is tried
ENOUGH = 8 * FIRST  # rows, evenly spread, that tell between periods which are nearly right
ROUNDING = 1e-6  # of times as numbers, relatively
JITTER = 0.01  # deviation of the rows from their clock, in samples, from which its ticks are other instants
AT_RANDOM = float(np.sqrt(1.0 / 12.0))  # jitter of rows that keep no clock
CLEAR = 4.0  # deviations of a tick beyond which a row is certainly before or after it
REMEMBERED = 16  # clocks kept, of a few recordings and parts of them: a search asks for each thousands of times


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
    def accuracy(self) -> Array:
        """Standard deviation (n,) to which the tick beside each row is known, in periods: that of a fitted line."""
        distance = self.ticks - np.mean(self.ticks)
        return np.asarray(self.jitter * np.sqrt(1.0 / self.ticks.size + distance**2 / np.sum(distance**2)))

    @property
    def irregular(self) -> bool:
        """Whether the jitter is more than rounded timestamps."""
        return self.jitter > IRREGULAR


def clock_of(time: Array) -> Clock:
    """The clock of rows at `time` (n,) [s], n at least 2, increasing: the line through the times over their ticks.

    The ticks are those of the period at which the rows' phases agree best, of the first rows and then of twice as many:
    jitter does not add up. Of two rows beside one tick, as where one was far too late, the one whose own tick is free
    is that one's; where many share a tick, they keep no clock and each counts as one.
    """
    return _clock_of(np.ascontiguousarray(time, dtype=np.float64).tobytes())


@lru_cache(maxsize=REMEMBERED)
def _clock_of(times: bytes) -> Clock:
    time = np.frombuffer(times)
    rows = min(FIRST, time.size)
    steps = np.diff(time[:rows])
    usual = float(np.median(steps))
    spread = float(np.percentile(np.abs(steps - usual), 68.0)) / usual
    reach = min(SEARCHED * 1.25 * spread / np.sqrt(steps.size), FARTHEST)  # 1.25: of a median, against a mean
    # the median of rounded steps is one of these; the mean is longer than the period by the share of rows that are lost
    by_mean = _agreeing(time[:rows], float(np.mean(steps)), max(reach, LOST))
    by_median = _agreeing(time[:rows], usual, reach)
    _, period, start = by_median if by_median[0] > AS_WELL * by_mean[0] else by_mean
    while rows < time.size:
        rows = min(2 * rows, time.size)
        two_cycles = 2.0 / rows
        _, period, start = _agreeing(time[: rows : -(-rows // ENOUGH)], period, two_cycles)
    cycles = (time - start) / period
    ticks = _one_each(cycles)
    if np.any(np.diff(ticks) < 1) or np.std(cycles - ticks) > AT_RANDOM:
        ticks, period = np.arange(time.size, dtype=np.float64), usual
    else:
        period = float(np.polyfit(ticks, time, 1)[0])
    start = float(np.mean(time - period * ticks))
    clock = Clock(
        period=period,
        start=start + period * ticks[0],
        ticks=(ticks - ticks[0]).astype(np.int64),
        off=(time - start) / period - ticks,
    )
    for shared in (clock.ticks, clock.off):
        shared.setflags(write=False)
    return clock


def _one_each(cycles: Array) -> Array:
    """The tick (n,) next to each row at `cycles` (n,) periods, with as few moved as lets each have one to itself.

    As they are where more share a tick than rows are lost of a clock. Ticks less the rows before them must not fall:
    the nearest such numbers by absolute differences, of which a row far too late moves none but its own.
    """
    ticks = np.rint(cycles)
    shared = np.count_nonzero(np.diff(ticks) < 1)
    if not 0 < shared <= LOST * ticks.size:
        return ticks
    highest, rising = list[float](), np.empty(ticks.size)
    for k, ahead in enumerate(ticks - np.arange(ticks.size)):
        heappush(highest, -ahead)
        if -highest[0] > ahead:
            heapreplace(highest, -ahead)
        rising[k] = -highest[0]
    rising = np.minimum.accumulate(rising[::-1])[::-1]
    found: Array = rising + np.arange(ticks.size)
    return found


def _agreeing(time: Array, period: float, reach: float) -> tuple[float, float, float]:
    """How well rows at `time` (n,) agree in phase at the best period within a relative `reach`, that, and a tick."""
    cycles = (time - time[0]) / period
    shifts = np.linspace(-reach, reach, 2 * int(np.ceil(PER_CYCLE * reach * cycles[-1])) + 1)
    sums = [complex(np.exp(2j * np.pi * (1.0 + shift) * cycles).sum()) for shift in shifts]
    best = int(np.argmax(np.abs(sums)))
    period = period / (1.0 + float(shifts[best]))
    return abs(sums[best]), period, float(time[0]) + period * float(np.angle(sums[best])) / (2.0 * np.pi)


def clock_beside(time: Array) -> Clock | None:
    """The clock beside whose ticks rows at `time` (n,) [s] were taken; None where it is theirs, or none is seen."""
    clock = clock_of(time)
    return clock if JITTER < clock.jitter < 0.5 and clock.lost < time.size else None


def written_to(time: Array) -> float:
    """The step [s] that times (n,) are whole multiples of, as few digits make them; 0: none."""
    steps = np.unique(np.diff(time))
    apart = np.diff(steps)
    apart = apart[apart > ROUNDING * steps[-1]]
    if not apart.size:
        return 0.0
    step = float(np.min(apart))
    return step if np.max(np.abs(time / step - np.rint(time / step))) < ROUNDING * time.size else 0.0
