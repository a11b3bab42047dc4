"""Whether one recording is a piece of another: a copy, a cut of it, one with a column left out, with fewer digits or
in other units; and how many rows two have in common."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rwn.recording.recording import Recording
from rwn.recording.signals import COLUMNS, MEASURED, si_unit
from rwn.recording.units import factor

Array = NDArray[np.float64]

_PROBES = 64  # rows by which most places are ruled out before whole stretches are compared
_READ = 2000  # rows whose digits are read: that all of 50 end in a 0 by chance happens once in 1e50 files
_DIGITS = 12  # after which the digits of a number may be those of a change of units
_CONVERTED = 1e-14  # relative: what is left of a number's digits by a change of units and back
_SAME = 1e-9  # relative: the same number, written with all digits that matter
_FACTOR = 1e-5  # relative: a change of units by a factor of five digits, such as 9.5493
_TINY = 1e-290  # below it a number is 0
_STRETCHES, _ROWS = 16, 100  # that are looked for in another recording, spread over one, and the rows of each
_CHANGES = 50  # rows of a stretch at which a sensor must change: noise repeats fewer than 1 in 2^50 of such by chance


def is_piece(part: Recording, whole: Recording) -> bool:
    """Whether the samples of `part`, whatever its time starts at, are successive samples of `whole` in every signal
    that both have, and these include a measured one.

    Samples of one may be those of the other rounded, up, down or to the nearest, or the same numbers under another
    unit. Two runs of the same profile are not: their noise differs, and where one is written with fewer digits the
    noise carries some samples across a step.
    """
    return any(_is_piece(part, rows) for rows in _as_dense(whole, part))


def _is_piece(part: Recording, whole: Recording) -> bool:
    both = _Both(part, whole)
    if not both.measured:
        return False
    if len(both.places(0, len(part))) > 0:
        return True
    relabelled = any(by != 1.0 for by in both.scales.values())
    return relabelled and len(_Both(_as_written(part), _as_written(whole)).places(0, len(part))) > 0


def _as_written(recording: Recording) -> Recording:
    """The same with the numbers of the file, whatever it says that they are in."""
    signals = {name: np.asarray(x) / _scale(recording, name) for name, x in recording.signals.items()}
    return replace(recording, signals=signals, units={})


def rows_in_common(part: Recording, whole: Recording) -> int:
    """How many rows of `part` stand in `whole` too, in the same order; 0 where that may be so without a copy.

    That is: at standstill, and where a stretch of `part` comes again within it, as a periodic test of a simulator does.
    Found is any stretch of 200 rows that is an eighth of `part`.
    """
    return max(_rows_in_common(part, rows) for rows in _as_dense(whole, part))


def _as_dense(whole: Recording, part: Recording) -> Iterator[Recording]:
    """A recording, and where its rows are several times as dense as those of `part`, every second or so of them."""
    yield whole
    every = _period(part) / max(_period(whole), _TINY)
    if every > 1.5 and len(whole) >= every * min(len(part), _ROWS):
        for first in range(round(every)):
            rows = slice(first, None, round(every))
            signals = {name: values[rows] for name, values in whole.signals.items()}
            missing = {name: lost[rows] for name, lost in whole.missing.items()}
            yield replace(whole, time=whole.time[rows], signals=signals, missing=missing)


def _period(recording: Recording) -> float:
    return float(np.median(np.diff(recording.time))) if len(recording) > 1 else 0.0


def _rows_in_common(part: Recording, whole: Recording) -> int:
    both = _Both(part, whole)
    if not both.measured or min(len(part), len(whole)) < _ROWS:
        return 0
    itself = _Both(part, part)
    for begin in np.unique(np.linspace(0, len(part) - _ROWS, _STRETCHES).astype(np.intp)):
        if _changes(part, both.shared, int(begin)) < _CHANGES:
            continue
        places = both.places(int(begin), _ROWS)
        if places.size and itself.places(int(begin), _ROWS).size == 1:
            return max(both.agreeing(int(k - begin)) for k in places)
    return 0


def _changes(recording: Recording, signals: list[str], begin: int) -> int:
    rows = [recording.signals[s][begin : begin + _ROWS] for s in signals if s in MEASURED]
    return max(int(np.count_nonzero(np.diff(values))) for values in rows)


class _Both:
    """Two recordings whose rows are compared."""

    def __init__(self, part: Recording, whole: Recording) -> None:
        self.part, self.whole = part, whole
        self.shared = [name for name in part.signals if name in whole.signals]
        self.measured = any(name in MEASURED for name in self.shared)
        self.steps = {name: (_steps(part, name), _steps(whole, name)) for name in self.shared}
        self.scales = {name: _scale(part, name) / _scale(whole, name) for name in self.shared}
        # a change of units other than by the decimal point is never exact in decimals
        self.converted = {s for s, by in self.scales.items() if abs(np.log10(by) - round(np.log10(by))) > _SAME}

    def places(self, begin: int, rows: int) -> NDArray[np.intp]:
        """The rows of `whole` from which on it is `part` from `begin` on, for so many rows."""
        places: NDArray[np.intp] = np.arange(max(len(self.whole) - rows + 1, 0) if rows else 0)
        for row in np.unique(np.linspace(0, rows - 1, _PROBES).astype(np.intp)) if rows else ():
            for name in self.shared:
                mine, theirs = self.part.signals[name][begin + row], self.whole.signals[name][places + row]
                allowed = self._allowed(name, slice(begin + row, begin + row + 1), places + row)
                places = places[np.abs(theirs - mine) <= allowed + self._slack(name) * np.abs(mine)]
        same = [all(self._same(name, begin, int(k), rows) for name in self.shared) for k in places]
        kept: NDArray[np.intp] = places[np.array(same, dtype=bool)]
        return kept

    def agreeing(self, shift: int) -> int:
        """How many rows of `part` are, in every signal, those of `whole` that stand `shift` later in it."""
        begin, end = max(0, -shift), min(len(self.part), len(self.whole) - shift)
        mine, theirs = slice(begin, end), slice(begin + shift, end + shift)
        alike = np.ones(end - begin, dtype=bool)
        for name in self.shared:
            values = self.part.signals[name][mine]
            off = np.abs(values - self.whole.signals[name][theirs])
            alike &= off <= self._allowed(name, mine, theirs) + self._slack(name) * np.abs(values)
        return int(np.count_nonzero(alike))

    def _same(self, name: str, begin: int, place: int, rows: int) -> bool:
        """Whether the stretches are one, in one signal, but for one rule of rounding."""
        here, there = slice(begin, begin + rows), slice(place, place + rows)
        mine, theirs = self.part.signals[name][here], self.whole.signals[name][there]
        allowed = self._allowed(name, here, there)
        off, slack = mine - theirs, self._slack(name) * np.abs(mine)
        if name in self.converted:  # each is rounded to its own steps
            fine, other = self.steps[name]
            return bool(np.all(np.abs(off) <= 0.5 * (fine[here] + other[there]) + slack))
        if np.any(np.abs(off) > allowed + slack):
            return False
        rounded = allowed > slack
        share = off[rounded] / allowed[rounded]
        away = share * np.sign(mine[rounded])  # towards zero the errors of both signs go opposite ways
        return share.size == 0 or bool(min(np.ptp(share), np.ptp(away)) <= 1.0 + 1e-6)

    def _allowed(self, name: str, mine: slice, theirs: slice | NDArray[np.intp]) -> Array:
        fine, other = self.steps[name]
        return np.maximum(fine[mine], other[theirs]) if name in self.converted else _allowed(fine[mine], other[theirs])

    def _slack(self, name: str) -> float:
        return _FACTOR if name in self.converted else _SAME


def _allowed(one: Array, other: Array) -> Array:
    """By how much rounded samples may differ: by the coarser step; with the same steps none was rounded."""
    coarse, fine = np.maximum(one, other), np.minimum(one, other)
    allowed: Array = np.where(coarse > 1.5 * fine, coarse, 0.0)
    return allowed


def _scale(recording: Recording, name: str) -> float:
    """The unit of the file, in SI."""
    unit = recording.units.get(name, "")
    return factor(unit, si_unit(COLUMNS[name], recording.linear), where=recording.name) if unit else 1.0


def _steps(recording: Recording, name: str) -> Array:
    """What each sample is rounded to (n,), in SI: the last decimal place of its decade in the file's unit, or that of
    single precision."""
    scale = _scale(recording, name)
    written = np.abs(recording.signals[name]) / scale
    decade = np.floor(np.log10(np.maximum(written, _TINY)) + _SAME)
    rows = np.unique(np.linspace(0, written.size - 1, min(written.size, _READ)).astype(np.intp))
    rows = rows[written[rows] > _TINY]
    if rows.size == 0:
        return np.zeros(written.size)
    places = _decimal_places(written[rows], decade[rows])
    finest = float(np.max(places))  # also of a 0, which may have been rounded to it
    most = {float(e): float(np.max(places[decade[rows] == e])) for e in np.unique(decade[rows])}
    decades, which = np.unique(decade, return_inverse=True)
    steps: Array = np.array([scale * 10.0 ** -most.get(float(e), finest) for e in decades])[which]
    single = written.astype(np.float32)
    if np.all(np.abs(written - single)[rows] <= _CONVERTED * written[rows]):
        steps = np.maximum(steps, scale * np.spacing(single))
    return steps


def _decimal_places(values: Array, decade: Array) -> Array:
    """How many decimal places (n,) each value needs; negative: it ends in zeros before the point."""
    found = _DIGITS - decade
    for digits in range(_DIGITS - 1, -1, -1):
        scaled = values * 10.0 ** (digits - decade)
        ends = np.abs(scaled - np.round(scaled)) <= _CONVERTED * scaled
        found[ends] = (digits - decade)[ends]
    return found
