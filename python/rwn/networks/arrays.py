"""The one gate between users' arrays and the C++ core: checks, words errors, makes contiguous float64."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array: TypeAlias = NDArray[np.float64]


def as_float_array(name: str, values: ArrayLike, ndim: int) -> Array:
    """Contiguous float64 copy or view of `values`, elementwise the same.

    Raises ValueError, naming `name`, if they are not real numbers, not finite, or not of `ndim` dimensions.
    """
    array = np.asarray(values)
    if array.dtype.kind not in "fiub":
        raise ValueError(f"{name} must hold real numbers, got {array.dtype}")
    if array.ndim != ndim:
        raise ValueError(f"{name} must have {ndim} dimension(s), got shape {array.shape}")
    array = np.ascontiguousarray(array, dtype=np.float64)
    if not np.isfinite(array).all():
        where = np.argwhere(~np.isfinite(array))[0].tolist()
        raise ValueError(f"{name} must be finite, got {array[tuple(where)]} at {where}: remove or repair it")
    return array


def as_patterns(name: str, values: ArrayLike) -> Array:
    """Array (patterns, columns); one dimension is read as one column.

    Raises InputError for what is no array of numbers of that shape.
    """
    array = np.asarray(values)
    return as_float_array(name, array[:, np.newaxis] if array.ndim == 1 else array, 2)


def as_pairs(x: ArrayLike, y: ArrayLike) -> tuple[Array, Array]:
    """Inputs (patterns, inputs) and wanted outputs (patterns, outputs) of the same number of patterns.

    Raises ValueError where the numbers of patterns differ.
    """
    xs, ys = as_patterns("x", x), as_patterns("y", y)
    if len(xs) != len(ys) or len(xs) == 0:
        raise ValueError(
            f"x and y must hold the same number of patterns, at least 1; got {len(xs)} and {len(ys)}"
        )
    return xs, ys


def read_only(array: Array) -> Array:
    """The same array, elementwise, protected against writing."""
    array.flags.writeable = False
    return array
