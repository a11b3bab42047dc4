"""MATLAB files up to version 7: variables and struct fields (`RawData.Velo`) named by the column map."""

from __future__ import annotations

import math
from collections.abc import Collection
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rwn.errors import InputError, unknown
from rwn.recording.formats.table import MAX_SAMPLES, Table, too_long


def read_mat(path: Path, wanted: Collection[str] = ()) -> Table:
    """The `wanted` variables only, so that a big file with many variables is not loaded whole."""
    shapes = _shapes(path)
    if not wanted:
        names = ", ".join(shapes) or "nothing"
        raise InputError(
            f"a .mat file needs a column map; this one holds {names}",
            where=path,
            expected="[recording.columns] in the model file",
            fix='write for instance: speed = { source = "RawData.Velo", unit = "rad/s" }',
        )
    roots = {name.split(".")[0] for name in wanted}
    for root in sorted(roots):
        if root not in shapes:
            raise unknown("variable", root, shapes, where=path)
        if math.prod(shapes[root]) > MAX_SAMPLES:
            raise too_long(path, math.prod(shapes[root]))
    content = _load(path, roots)
    columns = {name: _vector(path, name, _field(path, name, content)) for name in wanted}
    return Table(path=path, columns=columns, units=dict.fromkeys(columns), row=lambda k: f"sample {k + 1}")


def _shapes(path: Path) -> dict[str, tuple[int, ...]]:
    import scipy.io

    try:
        return {name: tuple(shape) for name, shape, _ in scipy.io.whosmat(str(path))}
    except NotImplementedError as error:
        raise InputError(
            "this .mat file is of version 7.3 (HDF5)",
            where=path,
            expected="version 7 or older",
            fix="save it in MATLAB with save(..., '-v7')",
        ) from error
    except Exception as error:  # scipy raises many kinds for a file that is no .mat file
        raise InputError(
            "this is not a .mat file",
            where=path,
            expected="a MATLAB file of version 7 or older",
            fix="save the recording again, or export it as CSV",
        ) from error


def _load(path: Path, roots: Collection[str]) -> dict[str, Any]:
    import scipy.io

    try:
        return dict(
            scipy.io.loadmat(path, variable_names=list(roots), squeeze_me=True, struct_as_record=False)
        )
    except Exception as error:
        raise InputError(
            "the .mat file is damaged", where=path, expected="a complete file", fix="copy or save it again"
        ) from error


def _field(path: Path, name: str, content: dict[str, Any]) -> Any:
    root, *fields = name.split(".")
    value: Any = content[root]
    for field in fields:
        known = list(getattr(value, "_fieldnames", ()))
        if field not in known:
            raise unknown("field", field, known, where=f"{path}, {root}")
        value = getattr(value, field)
    return value


def _vector(path: Path, name: str, value: Any) -> NDArray[np.float64]:
    array = np.asarray(value)
    if array.dtype.kind not in "fiub":
        raise InputError(
            f"'{name}' does not hold real numbers",
            where=path,
            expected="a vector of real numbers",
            fix="name a numeric variable or field, such as RawData.Velo",
        )
    if array.ndim != 1:
        raise InputError(
            f"'{name}' has shape {array.shape}",
            where=path,
            expected="a vector, one value per sample",
            fix="save each signal as its own vector",
        )
    return np.ascontiguousarray(array, dtype=np.float64)
