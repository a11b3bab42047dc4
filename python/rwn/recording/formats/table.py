"""Columns of numbers as a file holds them, before units and signal names."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rwn.errors import InputError

MAX_BYTES = 256 * 2**20
MAX_SAMPLES = 5_000_000


@dataclass(frozen=True, kw_only=True)
class Table:
    """`columns`: name -> (n_t,) float64 in the unit of `units` (None: not said). `row` names row k."""

    path: Path
    columns: Mapping[str, NDArray[np.float64]]
    units: Mapping[str, str | None]
    row: Callable[[int], str]


def too_long(path: Path, samples: int) -> InputError:
    """The error for a recording of more than MAX_SAMPLES samples."""
    return InputError(
        f"{samples} samples are too many",
        where=path,
        expected=f"at most {MAX_SAMPLES} samples",
        fix="cut out the part to be judged, or keep every k-th row",
    )
