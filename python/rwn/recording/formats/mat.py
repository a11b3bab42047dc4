"""MATLAB files: variables, fields of structs, columns of matrices, tables and timetables with their units."""

from __future__ import annotations

import math
import warnings
import zlib
from collections.abc import Callable, Collection
from pathlib import Path
from typing import Any

from rwn.errors import InputError
from rwn.recording.formats.extra import library
from rwn.recording.formats.mat_elements import check_elements
from rwn.recording.formats.nested import nested_table, roots
from rwn.recording.formats.table import MAX_SAMPLES, Table, too_long

Shapes = dict[str, tuple[int, ...]]
Load = Callable[[list[str]], dict[str, Any]]


def read_mat(path: Path, wanted: Collection[str] = ()) -> Table:
    """The `wanted` variables only, so that a big file with many variables is not loaded whole.

    Versions up to 7 are read by scipy; objects (tables, timetables) and version 7.3 by mat-io, an extra.
    Raises InputError for a file that is none, or that the extra is missing for.
    """
    where = str(path)
    shapes, load = _opened(path)
    read = sorted(shapes if len(shapes) == 1 else roots(shapes, wanted))
    for name in read:
        if math.prod(shapes[name]) > MAX_SAMPLES:
            raise too_long(where, math.prod(shapes[name]))
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            content = load(read) if read else {}
    except InputError:
        raise
    except Exception as error:
        raise InputError(
            "the .mat file is damaged", where=path, expected="a complete file", fix="copy or save it again"
        ) from error
    found = {name: content[name] for name in shapes if name in content}
    return nested_table(where, found, shapes, wanted)


def _opened(path: Path) -> tuple[Shapes, Load]:
    """The shapes of the variables, and what loads some of them."""
    import scipy.io

    try:
        check_elements(path)
    except (ValueError, zlib.error) as error:
        raise _no_mat(path) from error
    try:
        shapes = {name: tuple(shape) for name, shape, kind in scipy.io.whosmat(str(path)) if kind != "opaque"}
        return shapes, lambda names: dict(scipy.io.loadmat(path, variable_names=names))
    except NotImplementedError:
        pass  # version 7.3
    except Exception as error:  # scipy raises many kinds for a file that is no .mat file
        if not _holds_objects(path):
            raise _no_mat(path) from error
    matio = library("matio", "mat", path)
    try:
        shapes = {name: tuple(shape) for name, (shape, _) in matio.whosmat(str(path)).items()}
    except Exception as error:
        raise _no_mat(path) from error
    return shapes, lambda names: dict(matio.load_from_mat(str(path), variable_names=names, add_table_attrs=True))


def _holds_objects(path: Path) -> bool:
    """Whether it is a file of version 5 to 7 all the same: scipy cannot list one with a table or a timetable."""
    with path.open("rb") as file:
        head = file.read(128)
    return head.startswith(b"MATLAB 5.0") and head[126:128] in (b"IM", b"MI")


def _no_mat(path: Path) -> InputError:
    return InputError(
        "this is not a .mat file, or it is damaged",
        where=path,
        expected="a MATLAB file",
        fix="save the recording again, or export it as CSV",
    )
