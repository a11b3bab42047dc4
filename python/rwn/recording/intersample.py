"""How the input acted between the rows of a recording: held, bridged over lost rows, or changing at other instants.

Where rows lie between samples that were taken when the input changed, the law says so too. A law takes the rows' times
(n,) and input (n,) and gives the instants from which the input had which values, or None where it says the same as
"held". Adding one is a function and its line in `INTERSAMPLE`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from rwn.errors import unknown
from rwn.recording.clock import Clock, clock_of
from rwn.recording.interpolated import InterpolatedRows, interpolated_rows
from rwn.values import Values

Array = NDArray[np.float64]

JITTER = 0.01  # deviation of the rows from their clock, in samples, from which its ticks are other instants
CLEAR = 3.0  # deviations of a tick beyond which a row is certainly before or after it
FINE = 8  # parts of a sample that are as good as a line

AUTO = "auto"  # as the recordings show
HELD = "held"


@dataclass(frozen=True, kw_only=True, eq=False)
class PiecewiseInput(Values):
    """An input as it acted: from `instants` (m,) [s] it had `values` (m,), each known but for `spread` (m,).

    What no row shows lies anywhere between its neighbours: a standard deviation of their distance over sqrt(12).
    """

    instants: Array
    values: Array
    spread: Array

    def since(self, begin: float) -> PiecewiseInput:
        """The same of a recording that begins at `begin` [s], in its time."""
        first = max(int(np.searchsorted(self.instants, begin, side="right")) - 1, 0)
        instants = np.maximum(self.instants[first:], begin) - begin
        return PiecewiseInput(instants=instants, values=self.values[first:], spread=self.spread[first:])


def _own_samples(time: Array) -> None:
    """A row is what was at its time."""


@dataclass(frozen=True, kw_only=True)
class IntersampleLaw:
    """How an input acts between rows, and how that is said.

    `samples`: of rows at times (n,) that lie between samples at the ticks of a clock, how; `applied` then counts from
    the first tick. None: a row is what was at its time.
    """

    applied: Callable[[Array, Array], PiecewiseInput | None]
    words: str
    samples: Callable[[Array], InterpolatedRows | None] = _own_samples


def known_law(name: str, *, where: str) -> str:
    """The name of a law, or "auto". Raises InputError where there is none of that name."""
    if name not in (AUTO, *INTERSAMPLE):
        raise unknown("law between rows", name, (AUTO, *INTERSAMPLE), where=where)
    return name


def _held(time: Array, values: Array) -> None:
    """From its row to the next."""


def _bridged(time: Array, values: Array) -> PiecewiseInput | None:
    """As held; where rows were lost it changed at their ticks, on the line between its neighbours."""
    clock = clock_of(time)
    return _on_lines(time, values, np.diff(clock.ticks)) if 0 < clock.lost < time.size else None


def _in_parts(time: Array, values: Array, *, parts: int) -> PiecewiseInput | None:
    """It changed that often from row to row, on the line between its neighbours: a logger kept every so many rows."""
    clock = clock_of(time)
    ticks = np.diff(clock.ticks) if clock.lost < time.size else np.ones(time.size - 1, dtype=np.int64)
    return _on_lines(time, values, parts * ticks)


def _clock_beside(time: Array) -> Clock | None:
    """The clock beside whose ticks the rows were taken; None where it is theirs, or none is seen."""
    clock = clock_of(time)
    return clock if JITTER < clock.jitter < 0.5 and clock.lost < time.size else None


def between_ticks(time: Array) -> InterpolatedRows | None:
    """Rows at times (n,) as lines between samples at the ticks of the clock that they lie beside; None: of none."""
    clock = _clock_beside(time)
    return None if clock is None or np.abs(clock.off).max() >= 0.5 else interpolated_rows(time, clock)


def _at_ticks(time: Array, values: Array, *, begin: float | None = None) -> PiecewiseInput | None:
    """It changed at the ticks of a clock beside which the rows were taken: a row shows that of the last tick.

    `begin`: of the first tick [s]; None: as the rows' times have it.
    """
    clock = _clock_beside(time)
    if clock is None:
        return None
    begin, first_time = (clock.start, time[0]) if begin is None else (begin, begin)
    last = np.floor(clock.ticks + clock.off).astype(np.int64)  # tick before each row
    clear = np.abs(clock.off) > CLEAR * clock.accuracy  # of a row nearer to a tick nothing says which it shows
    clear[[0, -1]] = True
    last, values = last[clear], values[clear]
    first = np.concatenate([[True], np.diff(last) > 0])
    shown, seen = last[first], values[first]
    ticks = np.arange(last[0], last[-1] + 1)
    after = np.searchsorted(shown, ticks)  # the first shown tick that is not before each
    step = np.abs(np.diff(seen, prepend=seen[:1]))[after]
    instants = begin + clock.period * ticks
    instants[0] = first_time
    late = np.concatenate([[True], instants[1:] > first_time])
    return PiecewiseInput(
        instants=instants[late],
        values=np.interp(ticks, shown, seen)[late],
        spread=np.where(shown[after] == ticks, 0.0, step / np.sqrt(12.0))[late],
    )


def _on_lines(time: Array, values: Array, parts: NDArray[np.int64]) -> PiecewiseInput:
    """Each step from row to row in as many parts, on a line."""
    row = np.repeat(np.arange(parts.size), parts)
    done = (np.arange(row.size) - np.repeat(np.cumsum(parts) - parts, parts)) / parts[row]
    instants = time[row] + done * np.diff(time)[row]
    step = np.diff(values)[row]
    return PiecewiseInput(
        instants=np.append(instants, time[-1]),
        values=np.append(values[row] + done * step, values[-1]),
        spread=np.append(np.where(done > 0.0, np.abs(step) / np.sqrt(12.0), 0.0), 0.0),
    )


INTERSAMPLE: dict[str, IntersampleLaw] = {
    HELD: IntersampleLaw(applied=_held, words="each row's own, until the next"),
    "bridged": IntersampleLaw(applied=_bridged, words="it went on changing over the rows that are missing"),
    "halves": IntersampleLaw(
        applied=partial(_in_parts, parts=2),
        words="it changed twice from row to row, as where every second row was kept",
    ),
    "thirds": IntersampleLaw(
        applied=partial(_in_parts, parts=3),
        words="it changed three times from row to row, as where every third row was kept",
    ),
    "line": IntersampleLaw(applied=partial(_in_parts, parts=FINE), words="it moved on a line from row to row"),
    "ticks": IntersampleLaw(
        applied=_at_ticks, words="it changed at the ticks of a clock beside which the rows were taken"
    ),
    "interpolated": IntersampleLaw(
        applied=partial(_at_ticks, begin=0.0),
        words="it changed at the ticks of a clock, between whose samples the rows were interpolated",
        samples=between_ticks,
    ),
}
