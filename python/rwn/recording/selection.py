"""The part of a recording that is judged: a stretch of its time, and every k-th row of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rwn.errors import InputError
from rwn.recording.check import MIN_SAMPLES
from rwn.recording.layout import Layout
from rwn.recording.signals import MEASURED

Array = NDArray[np.float64]


class Selected(NamedTuple):
    """`time` (m,) and `signals` (m,) of the rows that are kept; `row` words the place of the k-th of them."""

    time: Array
    signals: dict[str, Array]
    row: Callable[[int], str]


def selected(
    time: Array, signals: Mapping[str, Array], layout: Layout, *, where: str, row: Callable[[int], str]
) -> Selected:
    """The rows (n,) from `layout.start` to `layout.end`, both in the file's own time, thinned by `layout.decimate`.

    What is measured is taken at the rows that are kept; an input is its mean until the next of them, so that what it
    does to a drive is kept. Raises InputError where too few are left.
    """
    if layout.start is None and layout.end is None and layout.decimate == 1:
        return Selected(time, dict(signals), row)
    low = -np.inf if layout.start is None else layout.start
    high = np.inf if layout.end is None else layout.end
    kept = np.flatnonzero((time >= low) & (time <= high))
    if not kept.size:
        raise InputError(
            f"no row is from {low:g} to {high:g} s",
            where=where,
            expected=f"times within {np.nanmin(time):g} to {np.nanmax(time):g} s" if time.size else "rows",
            fix="correct from and to under [recording]",
        )
    first, last = int(kept[0]), int(kept[-1]) + 1
    step = layout.decimate
    left = len(range(first, last, step))
    if left < MIN_SAMPLES <= time.size:
        raise InputError(
            f"from, to and decimate leave {left} of {time.size} samples",
            where=where,
            expected=f"at least {MIN_SAMPLES} samples",
            fix="widen from and to, or decimate by less, under [recording]",
        )
    thinned = {}
    for name, values in signals.items():
        part = values[first:last]
        thinned[name] = part[::step] if name in MEASURED else _means(part, step)
    return Selected(time[first:last:step], thinned, lambda k: row(first + k * step))


def _means(values: Array, step: int) -> Array:
    """The mean of every `step` values in a row, the last of those that are left."""
    starts = np.arange(0, values.size, step)
    sums: Array = np.add.reduceat(values, starts)
    return sums / np.diff(np.append(starts, values.size))
