"""Columns of numbers as a file or an object holds them, before units and signal names."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field
from decimal import Decimal
from numbers import Real
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rwn.errors import InputError

MAX_SAMPLES = 20_000_000  # 160 MB a signal


@dataclass(frozen=True, kw_only=True)
class Table:
    """`columns`: name -> (n_t,) float64 in the unit of `units` (None: not said), which names every column there is.

    `where` is the file or object in messages, `row` words the place of row k. `same`: further name of a column -> its
    own; a matrix is a further name of its first column. `notes`: what reading it found odd, a sentence each.
    """

    where: str
    columns: Mapping[str, NDArray[np.float64]]
    units: Mapping[str, str | None]
    row: Callable[[int], str] = lambda k: f"sample {k + 1}"
    same: Mapping[str, str] = field(default_factory=dict)
    notes: tuple[str, ...] = ()


def table_of(
    where: str, arrays: Mapping[str, Any], units: Mapping[str, Any], wanted: Collection[str]
) -> Table:
    """The `wanted` ones of named arrays as a table; a unit may be an object that is written as one (that of pint is).

    Instants and durations are in s. Raises InputError where one is no vector of real numbers.
    """
    columns = {name: vector(where, name, arrays[name]) for name in arrays if name in wanted}
    timed = {name: "s" for name in arrays if getattr(getattr(arrays[name], "dtype", None), "kind", "") in ("m", "M")}
    said = {name: None if units.get(name) is None else str(units[name]) for name in arrays}
    said |= {name: unit for name, unit in timed.items() if not said[name]}
    return Table(where=where, columns=columns, units=said)


def vector(where: str, name: str, values: Any) -> NDArray[np.float64]:
    """One column (n_t,) float64; instants and durations in s. Raises InputError."""
    refuse_mask(where, name, values)
    array = _as_numbers(np.atleast_1d(np.squeeze(np.asarray(values))))
    if array.dtype.kind == "M" and array.size:  # instants, as time since the first
        array = array - array.flat[0]
    if array.dtype.kind == "m":
        array = array / np.timedelta64(1, "s")
    if array.dtype.kind not in "fiub":
        raise InputError(
            f"'{name}' does not hold real numbers",
            where=where,
            expected="a vector of real numbers",
            fix="name a column of numbers, such as RawData.Velo in a struct",
        )
    if array.ndim != 1:
        raise InputError(
            f"'{name}' has shape {array.shape}",
            where=where,
            expected="a vector, one value per sample",
            fix=f"name one of its columns: '{name}(:,1)'" if array.ndim == 2 else "save each signal as a vector",
        )
    if array.size > MAX_SAMPLES:
        raise too_long(where, array.size)
    return np.ascontiguousarray(array, dtype=np.float64)


def _as_numbers(array: NDArray[Any]) -> NDArray[Any]:
    """Numbers that are kept as objects, such as decimals, None as nan; what else it holds stays as it is."""
    if array.dtype != object or not all(x is None or isinstance(x, Real | Decimal) for x in array.flat):
        return array
    try:
        return array.astype(np.float64)
    except OverflowError:
        return array


def refuse_doubles(where: str, names: Sequence[str], wanted: Collection[str]) -> None:
    """Raises InputError where a wanted column is there twice, as `speed [rpm]` and `speed [rad/s]`: which is meant?"""
    double = next((name for name in names if name in wanted and names.count(name) > 1), None)
    if double is not None:
        raise InputError(
            f"two columns are called '{double}'",
            where=where,
            expected="each name once",
            fix="rename or remove one of them",
        )


def refuse_mask(where: str, name: str, values: Any) -> None:
    """Raises InputError where samples are masked: numpy would take what stands beneath as measured."""
    lost = int(np.count_nonzero(np.ma.getmaskarray(values))) if isinstance(values, np.ma.MaskedArray) else 0
    if lost:
        raise InputError(
            f"{lost} of {values.size} samples of '{name}' are masked", where=where, expected="a value for each instant",
            fix="interpolate them; a Recording takes missing={name: flags} beside them",
        )  # fmt: skip


def too_long(where: str, samples: int) -> InputError:
    """The error for a recording of more than MAX_SAMPLES samples."""
    return InputError(
        f"{samples} samples are too many",
        where=where,
        expected=f"at most {MAX_SAMPLES} samples",
        fix="cut out the part to be judged before, or keep every k-th row",
    )
