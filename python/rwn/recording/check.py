"""Are the samples of a recording usable at all? Every refusal is one line with the row and the remedy."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from rwn.errors import InputError, unrecognised
from rwn.recording.clock import clock_beside
from rwn.recording.signals import COLUMNS, SIGNALS, si_unit
from rwn.recording.units import factor

MIN_SAMPLES = 50
SMALLEST, LARGEST = 1e-12, 1e12  # of the largest value of a signal in SI that moves: no drive comes near either
GAP_WARNED, GAP_REFUSED = 2.5, 20.0  # times the median sample time: from two lost rows on

Row = Callable[[int], str]
Array = NDArray[np.float64]


def check_samples(
    time: Array, signals: Mapping[str, Array], *, where: str, row: Row, fewest: int = MIN_SAMPLES
) -> tuple[str, ...]:
    """Finite values (n,), time that runs forward without gaps, one length, enough samples. Returns warnings.

    A step in time above 20 median steps is refused (the input in between is unknown), above 3 warned of.
    `row` words the place of sample k. Raises InputError.
    """
    check_lengths(time, signals, where=where)
    if len(time) < fewest:
        raise InputError(
            f"{len(time)} samples are too few",
            where=where,
            expected=f"at least {fewest} samples",
            fix="record longer or sample faster",
        )
    for name, values in {"time": time, **signals}.items():
        _check_finite(name, values, row)
    return _check_time(time, row)


def check_lengths(time: Array, signals: Mapping[str, Array], *, where: str) -> None:
    """Every signal (n,) has one value per instant of `time` (n,). Raises InputError."""
    for name, values in signals.items():
        if len(values) != len(time):
            raise InputError(
                f"'{name}' has {len(values)} samples, time has {len(time)}",
                where=where,
                expected="one value per instant",
                fix="cut them to the same instants",
            )


def check_beside(
    units: Mapping[str, str], missing: Iterable[str], input_noise: float, *, linear: bool, where: str
) -> None:  # fmt: skip
    """What a recording says beside its signals is of signals that there are, in units of theirs. Raises InputError."""
    for table, names, known in (("units", units, COLUMNS), ("missing", missing, SIGNALS)):
        for name in names:
            if name not in known:
                raise unrecognised("signal", name, known, where=f"{where}, {table}")
    for name, unit in units.items():
        wanted = si_unit(COLUMNS[name], linear)
        if unit and not _is_of(unit, wanted):
            factor(unit, wanted, where=f"{where}, units of {name}", strict_angle=False)  # says what is wrong
    if not 0.0 <= input_noise < math.inf:
        raise InputError(
            f"input_noise is {input_noise!r}", where=where, expected="a deviation: 0 or more", fix="leave it out"
        )


@lru_cache(maxsize=256)  # each takes pint a third of a millisecond
def _is_of(unit: str, wanted: str) -> bool:
    try:
        factor(unit, wanted, where="", strict_angle=False)
    except InputError:
        return False
    return True


def _check_finite(name: str, values: Array, row: Row) -> None:
    bad = np.flatnonzero(~np.isfinite(values))
    if len(bad):
        others = f" (and {len(bad) - 1} more)" if len(bad) > 1 else ""
        raise InputError(
            f"{name} is {values[bad[0]]}{others}",
            where=row(int(bad[0])),
            expected="finite numbers",
            fix="remove the row, or cut the recording there (from, to under [recording])",
        )
    peak = float(np.max(np.abs(values)))
    if peak > LARGEST or (peak < SMALLEST and np.ptp(values) > 0.0):
        raise InputError(
            f"{name} goes to {peak:g} in SI",
            where=row(int(np.argmax(np.abs(values)))),
            expected=f"a signal between {SMALLEST:g} and {LARGEST:g}",
            fix="correct its unit or scale",
        )


def _check_time(time: Array, row: Row) -> tuple[str, ...]:
    steps = np.diff(time)
    back = np.flatnonzero(steps <= 0)
    if len(back):
        k = int(back[0])
        does = "stands still" if steps[k] == 0 else "runs back"
        raise InputError(
            f"time {does} at {time[k + 1]:g} s",
            where=row(k + 1),
            expected="time that increases",
            fix="sort the rows, remove doubles, or cut the recording there",
        )
    usual = float(np.median(steps))
    k = int(np.argmax(steps))
    if steps[k] > GAP_REFUSED * usual:
        raise InputError(
            f"a gap of {steps[k]:g} s, {steps[k] / usual:.0f} sample times",
            where=row(k + 1),
            expected=f"no gap above {GAP_REFUSED:g} sample times",
            fix="cut the recording in two there",
        )
    if np.max(steps) <= GAP_WARNED * usual:
        return ()
    clock = clock_beside(time)  # a row that came late is none that is missing
    steps = np.diff(clock.ticks).astype(np.float64) if clock else steps / usual
    gaps, k = int(np.count_nonzero(steps > GAP_WARNED)), int(np.argmax(steps))
    if gaps == 0:
        return ()
    return (f"{row(k + 1)}: {gaps} gap(s) of up to {steps[k]:.1f} sample times, where rows are missing",)
