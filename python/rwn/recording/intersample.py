"""How the input acted between the rows of a recording: held, bridged over lost rows, or changing at other instants.

Where rows lie between samples that were taken when the input changed, the law says so too. A law takes the rows' times
(n,) and input (n,) and gives the instants from which the input had which values, or None where it says the same as
"held". Adding one is a function and its line in `INTERSAMPLE`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from rwn.errors import unrecognised
from rwn.recording.clock import CLEAR, Clock, clock_beside, clock_of
from rwn.recording.interpolated import InterpolatedRows, between_ticks, rounded, stamped
from rwn.recording.noise import noise_from_differences
from rwn.values import Values

Array = NDArray[np.float64]

FINE = 8  # parts of a sample that are as good as a line

AUTO = "auto"  # as the recordings show
HELD = "held"


@dataclass(frozen=True, kw_only=True, eq=False)
class PiecewiseInput(Values):
    """An input as it acted: from `instants` (m,) [s] it had `values` (m,), each known but for `spread` (m,).

    What no row shows lies off the line between its neighbours, as far as the way through them bends: it may be anywhere
    in that, of which 1/sqrt(12) is the standard deviation. `gaps`: neighbours that are not known lie off it together
    where their numbers (m,) are the same; None: each by itself. `noise_left`: the share of the noise of a signal
    that is left in its errors where the values were inferred from these. `ramps`: it may move from value to value.
    `log_ways`: logarithm of the number of ways between which the values were chosen by the errors.
    """

    instants: Array
    values: Array
    spread: Array
    gaps: NDArray[np.int64] | None = None
    noise_left: Mapping[str, float] = field(default_factory=dict)
    ramps: bool = False
    log_ways: float = 0.0

    def since(self, begin: float) -> PiecewiseInput:
        """The input of the recording from `begin` [s] on, in the time of that part."""
        first = max(int(np.searchsorted(self.instants, begin, side="right")) - 1, 0)
        instants = np.maximum(self.instants[first:], begin) - begin
        gaps = None if self.gaps is None else self.gaps[first:]
        return replace(self, instants=instants, values=self.values[first:], spread=self.spread[first:], gaps=gaps)


def _own_samples(time: Array) -> None:
    """A row is what was at its time."""


@dataclass(frozen=True, kw_only=True)
class IntersampleLaw:
    """How an input acts between rows, and how that is said.

    `said`: what goes before that, of a `given` input. `samples`: of rows at times (n,) that lie between samples at the
    ticks of a clock, how; `applied` then counts from the first tick. None: a row is what was at its time. `shown`: the
    times of the rows show that it may be so.
    `ticks_per_row`: of the drive's clock, by which its filters run too.
    """

    applied: Callable[[Array, Array], PiecewiseInput | None]
    words: str
    said: str = "between two rows the {given} was not held: "
    shown: bool = False
    ticks_per_row: int = 1
    samples: Callable[[Array], InterpolatedRows | None] = _own_samples


def known_law(name: str, *, where: str) -> str:
    """The name of a law, or "auto". Raises InputError where there is none of that name."""
    if name not in (AUTO, *INTERSAMPLE):
        raise unrecognised("law between rows", name, (AUTO, *INTERSAMPLE), where=where)
    return name


def _held(time: Array, values: Array) -> None:
    """From its row to the next."""


def _bridged(time: Array, values: Array) -> PiecewiseInput | None:
    """As held; where rows were lost it changed at their ticks, on the curve through its neighbours."""
    clock = clock_of(time)
    return _divided(time, values, np.diff(clock.ticks), _on_curve) if 0 < clock.lost < time.size else None


def _in_parts(time: Array, values: Array, *, parts: int) -> PiecewiseInput | None:
    """It changed that often from row to row, on the curve through its values: a logger kept every so many rows."""
    clock = clock_of(time)
    ticks = np.diff(clock.ticks) if clock.lost < time.size else np.ones(time.size - 1, dtype=np.int64)
    return _divided(time, values, parts * ticks, _on_curve)


def _linear(time: Array, values: Array) -> PiecewiseInput | None:
    """It moved on the line from row to row."""
    return replace(_divided(time, values, np.full(time.size - 1, FINE), _on_line), ramps=True)


def _noted_late(time: Array, values: Array) -> PiecewiseInput:
    """A row has the input that acted since the row before, as of a logger that notes the command of the last cycle."""
    return PiecewiseInput(instants=time, values=np.append(values[1:], values[-1]), spread=np.zeros(values.size))


def _held_from_ticks(
    time: Array, values: Array, *, samples: Callable[[Array], InterpolatedRows | None]
) -> PiecewiseInput | None:
    """As held, from tick to tick of `samples`; over lost rows as bridged."""
    rows = samples(time)
    if rows is None:
        return None
    return _bridged(rows.ticks, values) or PiecewiseInput(
        instants=rows.ticks, values=values, spread=np.zeros(values.size)
    )


def _at_ticks(time: Array, values: Array, *, begin: float | None = None) -> PiecewiseInput | None:
    """It changed at the ticks of a clock beside which the rows were taken: a row shows that of the last tick.

    `begin`: of the first tick [s]; None: as the rows' times have it.
    """
    clock = clock_beside(time)
    if clock is None:
        return None
    begin, first_time = (clock.start, time[0]) if begin is None else (begin, begin)
    last, unclear = _last_ticks(clock, values)
    ticks = np.arange(last[0], last[-1] + 1)
    of_rows = (np.maximum.accumulate(np.where(unclear, clock.ticks - k, last)) for k in (0, 1))
    after, before = (_shown_at(ticks, shown, values) for shown in of_rows)
    mixed, spread = _mixed(_chance_after(clock, unclear, ticks), after, before)
    gaps = np.where(after[0] == before[0], _gaps(ticks, last), -1 - ticks)  # one that may be another is by itself
    instants = begin + clock.period * ticks
    instants[0] = first_time
    late = np.concatenate([[True], instants[1:] > first_time])
    return PiecewiseInput(instants=instants[late], values=mixed[late], spread=spread[late], gaps=gaps[late])


def _before_rows(time: Array, values: Array) -> PiecewiseInput | None:
    """It changed at ticks that the rows were taken after, the promptest at once: each shows that of its own."""
    clock = clock_beside(time)
    if clock is None:
        return None
    ticks = np.arange(clock.ticks[-1] + 1)
    shown, spread = _shown_at(ticks, clock.ticks, values)
    instants = clock.start + clock.period * (ticks + np.min(clock.off))
    instants[0] = time[0]
    return PiecewiseInput(instants=instants, values=shown, spread=spread, gaps=_gaps(ticks, clock.ticks))


def _gaps(ticks: NDArray[np.int64], last: NDArray[np.int64]) -> NDArray[np.int64]:
    """How many ticks that rows show, `last` (n,), are before each of `ticks` (m,)."""
    return np.searchsorted(np.unique(last), ticks)


def _last_ticks(clock: Clock, values: Array) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
    """The tick before each row, and whether it may as well be the one before that, (n,) each.

    It is where the row is nearer to a tick than that is known, unless a neighbour shows that tick with another value.
    """
    last = np.floor(clock.ticks + clock.off).astype(np.int64)
    unclear = np.abs(clock.off) < CLEAR * clock.accuracy
    unclear[[0, -1]] = False
    another = np.abs(np.diff(values)) > CLEAR * noise_from_differences(values)  # than that of the row before
    rows = np.flatnonzero(unclear)
    by_next = ~unclear[rows + 1] & (last[rows + 1] == clock.ticks[rows]) & another[rows]
    by_previous = ~unclear[rows - 1] & (last[rows - 1] == clock.ticks[rows] - 1) & another[rows - 1]
    last[rows[by_next]] = clock.ticks[rows[by_next]] - 1
    last[rows[by_previous]] = clock.ticks[rows[by_previous]]
    unclear[rows[by_next | by_previous]] = False
    return last, unclear


def _chance_after(clock: Clock, unclear: NDArray[np.bool_], ticks: NDArray[np.int64]) -> Array:
    """That the row which `ticks` (m,) hang on was taken after its own: the last unclear one up to the next tick."""
    from scipy.special import ndtr  # late: the command line starts without it

    if not unclear.any():
        return np.ones(ticks.size)
    place = np.searchsorted(clock.ticks[unclear], ticks + 1, side="right") - 1
    chance = ndtr(clock.off[unclear] / clock.accuracy[unclear])
    return np.where(place < 0, 1.0, chance[np.maximum(place, 0)])


def _shown_at(ticks: NDArray[np.int64], last: NDArray[np.int64], values: Array) -> tuple[Array, Array]:
    """Value and deviation of an input at `ticks`, (m,) each, where rows of `values` show that of tick `last`, (n,)."""
    first = np.concatenate([[True], np.diff(last) > 0])
    shown, seen = last[first].astype(np.float64), values[first]
    next_shown = np.minimum(np.searchsorted(shown, ticks), shown.size - 1)
    off = np.concatenate([[0.0], _off_the_line(shown, seen)])[next_shown]
    curve = _on_curve(ticks.astype(np.float64), shown, seen)
    known = shown[next_shown] == ticks
    return np.where(known, seen[next_shown], curve), np.where(known, 0.0, off)


def _mixed(share: Array, one: tuple[Array, Array], other: tuple[Array, Array]) -> tuple[Array, Array]:
    """Mean and deviation (m,) of what is `one` with this probability (m,), and else the `other`."""
    mean = share * one[0] + (1.0 - share) * other[0]
    variance = share * one[1] ** 2 + (1.0 - share) * other[1] ** 2 + share * (1.0 - share) * (one[0] - other[0]) ** 2
    return np.where(one[0] == other[0], one[0], mean), np.sqrt(variance)


def _divided(
    time: Array, values: Array, parts: NDArray[np.int64], between: Callable[[Array, Array, Array], Array]
) -> PiecewiseInput:
    """Each step from row to row in as many parts, of values `between` those of the rows."""
    row = np.repeat(np.arange(parts.size), parts)
    done = (np.arange(row.size) - np.repeat(np.cumsum(parts) - parts, parts)) / parts[row]
    instants = time[row] + done * np.diff(time)[row]
    return PiecewiseInput(
        instants=np.append(instants, time[-1]),
        values=np.append(np.where(done > 0.0, between(instants, time, values), values[row]), values[-1]),
        spread=np.append(np.where(done > 0.0, _off_the_line(time, values)[row], 0.0), 0.0),
        gaps=np.append(row, time.size),
    )


def _on_line(when: Array, time: Array, values: Array) -> Array:
    """At `when` (m,), on the line from row to row."""
    return np.interp(when, time, values)


def _on_curve(when: Array, time: Array, values: Array) -> Array:
    """At `when` (m,), on a cubic spline through the rows, but no farther off the line than the input may be."""
    from scipy.interpolate import CubicSpline  # late: the command line starts without it

    line = _on_line(when, time, values)
    most = np.append(np.sqrt(3.0) * _off_the_line(time, values), 0.0)
    most = most[np.clip(np.searchsorted(time, when, side="right") - 1, 0, time.size - 1)]
    curve = CubicSpline(time, values)(when) if time.size > 2 else line
    return np.asarray(np.clip(curve, line - most, line + most))


def _off_the_line(time: Array, values: Array) -> Array:
    """Deviation (n - 1,) of an input between rows at `time` (n,) from the line between its values (n,) there.

    As far as the way through the rows bends at both of its ends, and no farther than the input moves about there.
    """
    lasting, step = np.diff(time), np.abs(np.diff(values))
    if step.size < 2:
        return np.asarray(step / np.sqrt(12.0))
    bend = np.abs(np.diff(np.diff(values) / lasting))
    bends = np.minimum(np.append(bend, bend[-1]), np.append(bend[0], bend)) * lasting
    about = np.maximum(step, np.maximum(np.append(step[1:], 0.0), np.append(0.0, step[:-1])))
    return np.asarray(np.minimum(bends, about) / np.sqrt(12.0))


def _thinned(ticks_per_row: int, words: str) -> IntersampleLaw:
    """Of rows that show one of so many ticks of the drive's clock, at each of which the input changed."""
    return IntersampleLaw(applied=partial(_in_parts, parts=ticks_per_row), ticks_per_row=ticks_per_row, words=words)


INTERSAMPLE: dict[str, IntersampleLaw] = {
    HELD: IntersampleLaw(applied=_held, shown=True, words="each row's own, until the next"),
    "bridged": IntersampleLaw(applied=_bridged, shown=True, words="it went on changing over the rows that are missing"),
    "halves": _thinned(2, "it changed twice from one to the next, as where a logger keeps every second one"),
    "thirds": _thinned(3, "it changed three times from one to the next, as where a logger keeps every third one"),
    "line": IntersampleLaw(applied=_linear, words="it moved on a line from row to row"),
    "noted-late": IntersampleLaw(
        applied=_noted_late,
        said="the {given} was noted a row late: ",
        words="each row has what acted since the one before",
    ),
    "ticks": IntersampleLaw(
        applied=_at_ticks, shown=True, words="it changed at the ticks of a clock beside which the rows were taken"
    ),
    "latency": IntersampleLaw(
        applied=_before_rows,
        shown=True,
        words="it changed at the ticks of a clock, and each row was taken some time after its own",
    ),
    "interpolated": IntersampleLaw(
        applied=partial(_at_ticks, begin=0.0),
        shown=True,
        words="it changed at the ticks of a clock, between whose samples the rows were interpolated",
        samples=between_ticks,
    ),
    "rounded": IntersampleLaw(
        applied=partial(_held_from_ticks, samples=rounded),
        shown=True,
        words="it changed at the ticks of a clock, which the times of the rows are rounded from",
        samples=rounded,
    ),
    "stamped": IntersampleLaw(
        applied=partial(_held_from_ticks, samples=stamped),
        words="it changed at the ticks of a clock, beside which the times of the rows were noted",
        samples=stamped,  # not `shown`: it says that the times are wrong
    ),
}
