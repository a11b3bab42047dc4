"""What a sample should be by those beside it and by the input: a linear interpolation that knows steps of the input."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rwn.recording.inspection.outliers import REACH
from rwn.recording.noise import PER_MEDIAN

Array = NDArray[np.float64]

ROUNDS = 4  # of reweighting
HUBER = 1.345  # deviations beyond which an error counts linearly: 95 % efficient for normal ones (Huber 1964)


class Interpolated(NamedTuple):
    """How far samples are off their interpolation."""

    errors: Array  # (n,); 0 at the ends
    of_one: Array  # (2 REACH + 1,): the errors of a sample that is off by itself and of those beside it, over its own


def interpolated(x: Array, inputs: Sequence[Array]) -> Interpolated:
    """The samples x (n,) against what those within `REACH` and the inputs (n,) there make of them.

    Linear, as the answer of a drive of two states is, with the coefficients that the whole signal shows (Huber's
    M-estimate, so that a few samples that are far off do not decide).
    """
    if x.size < 8 * (2 * REACH + 1):
        return Interpolated(np.zeros(x.size), np.zeros(2 * REACH + 1))
    off, by = _regression(x, inputs)
    coefficients = _least_squares(by, off)
    for _ in range(ROUNDS):
        size = np.abs(off - by @ coefficients)
        usual = HUBER * PER_MEDIAN * float(np.median(size))
        weights = np.sqrt(usual / np.maximum(size, usual)) if usual else np.ones(size.size)
        coefficients = _least_squares(by * weights[:, None], off * weights)
    errors = off - by @ coefficients
    alone = np.zeros(4 * REACH + 1)
    alone[2 * REACH] = 1.0
    off, by = _regression(alone, [np.zeros(alone.size)] * len(inputs))
    of_one = off - by @ coefficients
    return Interpolated(np.pad(errors, REACH), of_one / of_one[REACH])


def _regression(x: Array, inputs: Sequence[Array]) -> tuple[Array, Array]:
    """Each sample that has `REACH` on either side, off the mean of the two beside it, and what that is explained by."""
    off = _shifted(x, 0) - 0.5 * (_shifted(x, -1) + _shifted(x, 1))
    columns = [_shifted(x, k) - _shifted(x, k - 1) for k in range(1 - REACH, REACH + 1) if k not in (0, 1)]
    columns.append(_shifted(x, 1) - _shifted(x, -1))
    columns += [_shifted(u, k) - _shifted(u, k - 1) for u in inputs for k in range(1 - REACH, REACH + 1)]
    return off, np.stack(columns, axis=1)


def _least_squares(by: Array, of: Array) -> Array:
    return np.asarray(np.linalg.lstsq(by, of, rcond=1e-10)[0], dtype=np.float64)


def _shifted(x: Array, by: int) -> Array:
    """The samples so many after those that have `REACH` on either side."""
    return x[REACH + by : x.size - REACH + by]
