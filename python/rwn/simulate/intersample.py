"""How the input acted between the rows of a recording: held, bridged over lost rows, or changing at other instants.

A law takes the rows' times (n,) and input (n,) and gives the instants (m,) from which the input had the values (m,), or
None where it says the same as "held".
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
from numpy.typing import NDArray

from rwn.recording.clock import Clock, clock_of
from rwn.recording.columns import Intersample

Array = NDArray[np.float64]
Law = Callable[[Array, Array], tuple[Array, Array] | None]

JITTER = 0.01  # deviation of the rows from their clock, in samples, from which its ticks are other instants
FINE = 8  # parts of a sample that are as good as a line

HELD: Intersample = "held"


def _held(time: Array, values: Array) -> None:
    """From its row to the next."""


def _bridged(time: Array, values: Array) -> tuple[Array, Array] | None:
    """As held; where rows were lost it changed at their ticks, on the line between its neighbours."""
    clock = clock_of(time)
    return _on_lines(time, values, np.diff(clock.ticks)) if 0 < clock.lost < time.size else None


def _in_parts(time: Array, values: Array, *, parts: int) -> tuple[Array, Array] | None:
    """It changed that often from row to row, on the line between its neighbours: a logger kept every so many rows."""
    clock = clock_of(time)
    ticks = np.diff(clock.ticks) if clock.lost < time.size else np.ones(time.size - 1, dtype=np.int64)
    return _on_lines(time, values, parts * ticks)


def _at_ticks(time: Array, values: Array) -> tuple[Array, Array] | None:
    """It changed at the ticks of a clock beside which the rows were taken: a row shows that of the last tick."""
    clock = clock_of(time)
    if not JITTER < clock.jitter < 0.5 or clock.lost >= time.size:
        return None
    last = np.floor(clock.ticks + clock.off).astype(np.int64)  # tick before each row
    first = np.concatenate([[True], np.diff(last) > 0])
    ticks = np.arange(last[0] + 1, last[-1] + 1)
    return _from_the_first_row(time, values, clock, ticks, np.interp(ticks, last[first], values[first]))


def _from_the_first_row(
    time: Array, values: Array, clock: Clock, ticks: NDArray[np.int64], at_ticks: Array
) -> tuple[Array, Array]:
    instants = clock.start + clock.period * ticks
    after = instants > time[0]
    return (
        np.concatenate([time[:1], instants[after]]),
        np.concatenate([values[:1], at_ticks[after]]),
    )


def _on_lines(time: Array, values: Array, parts: NDArray[np.int64]) -> tuple[Array, Array]:
    """Each step from row to row in as many parts, on a line."""
    row = np.repeat(np.arange(parts.size), parts)
    done = (np.arange(row.size) - np.repeat(np.cumsum(parts) - parts, parts)) / parts[row]
    instants = time[row] + done * np.diff(time)[row]
    between = values[row] + done * np.diff(values)[row]
    return np.concatenate([instants, time[-1:]]), np.concatenate([between, values[-1:]])


INTERSAMPLE: dict[Intersample, Law] = {
    HELD: _held,
    "bridged": _bridged,
    "halves": partial(_in_parts, parts=2),
    "thirds": partial(_in_parts, parts=3),
    "line": partial(_in_parts, parts=FINE),
    "ticks": _at_ticks,
}
