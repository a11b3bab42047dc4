"""Whether one recording is a piece of another: a copy, a cut of it, one with a column left out or with fewer digits."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rwn.recording.columns import si_unit
from rwn.recording.recording import Recording
from rwn.recording.signals import COLUMNS, MEASURED
from rwn.recording.units import factor

Array = NDArray[np.float64]

_PROBES = 64  # rows by which most places are ruled out before whole stretches are compared
_READ = 2000  # rows whose digits are read: that all of 50 end in a 0 by chance happens once in 1e50 files
_DIGITS = 12  # after which the digits of a number may be those of a change of units
_CONVERTED = 1e-14  # relative: what is left of a number's digits by a change of units and back
_SAME = 1e-9  # relative: the same number, written with all digits that matter
_TINY = 1e-290  # below it a number is 0


def is_piece(part: Recording, whole: Recording) -> bool:
    """Whether the samples of `part`, whatever its time starts at, are successive samples of `whole` in every signal
    that both have, and these include a measured one.

    Samples of one may be those of the other rounded, up, down or to the nearest. Two runs of the same profile are not:
    their noise differs, and where one is written with fewer digits the noise carries some samples across a step.
    """
    shared = [name for name in part.signals if name in whole.signals]
    if not 0 < len(part) <= len(whole) or not any(name in MEASURED for name in shared):
        return False
    steps = {name: (_steps(part, name), _steps(whole, name)) for name in shared}
    places: NDArray[np.intp] = np.arange(len(whole) - len(part) + 1)
    for row in np.unique(np.linspace(0, len(part) - 1, _PROBES).astype(np.intp)):
        for name in shared:
            at = places + row
            mine, theirs = part.signals[name][row], whole.signals[name][at]
            allowed = _allowed(steps[name][0][row], steps[name][1][at])
            places = places[np.abs(theirs - mine) <= allowed + _SAME * np.abs(mine)]
    return any(all(_same(part, whole, name, int(k), *steps[name]) for name in shared) for k in places)


def _same(part: Recording, whole: Recording, name: str, begin: int, fine: Array, other: Array) -> bool:
    """Whether `part` is `whole` from row `begin` on, in one signal, but for one rule of rounding."""
    rows = slice(begin, begin + len(part))
    mine, theirs = part.signals[name], whole.signals[name][rows]
    allowed = _allowed(fine, other[rows])
    off, slack = mine - theirs, _SAME * np.abs(mine)
    if np.any(np.abs(off) > allowed + slack):
        return False
    rounded = allowed > slack
    share = off[rounded] / allowed[rounded]
    away = share * np.sign(mine[rounded])  # towards zero the errors of both signs go opposite ways
    return share.size == 0 or bool(min(np.ptp(share), np.ptp(away)) <= 1.0 + 1e-6)


def _allowed(one: Array, other: Array) -> Array:
    """By how much rounded samples may differ: by the coarser step; with the same steps none was rounded."""
    coarse, fine = np.maximum(one, other), np.minimum(one, other)
    allowed: Array = np.where(coarse > 1.5 * fine, coarse, 0.0)
    return allowed


def _steps(recording: Recording, name: str) -> Array:
    """What each sample is rounded to (n,), in SI: the last decimal place of its decade in the file's unit, or that of
    single precision."""
    unit = recording.units.get(name, "")
    si = si_unit(COLUMNS[name], recording.linear)
    scale = factor(unit, si, where=recording.name) if unit else 1.0
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
