"""NumPy's files: named arrays (.npz), or one array with named fields or columns (.npy)."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace
from pathlib import Path

import numpy as np

from rwn.errors import InputError
from rwn.recording.formats.frame import name_and_unit_of
from rwn.recording.formats.nested import nested_table, roots
from rwn.recording.formats.table import Table, refuse_doubles


def read_npz(path: Path, wanted: Collection[str] = ()) -> Table:
    """The `wanted` arrays; a name may carry its unit, `speed [rpm]`. Pickled objects are not read.

    Raises InputError for a file that is none.
    """
    try:
        with path.open("rb") as file:
            loaded = np.load(file, allow_pickle=False)
            fields = loaded.dtype.names if isinstance(loaded, np.ndarray) else loaded.files
            if fields is None:
                return nested_table(str(path), {path.stem: loaded}, (path.stem,), wanted)
            names = {key: name_and_unit_of(key) for key in fields}
            refuse_doubles(str(path), [name for name, _ in names.values()], wanted)
            read = roots((name for name, _ in names.values()), wanted)
            content = {name: loaded[key] for key, (name, _) in names.items() if name in read}
    except (InputError, OSError):
        raise
    except Exception as error:  # numpy and zipfile raise many kinds for what is none
        raise InputError(
            "the arrays cannot be read",
            where=path,
            expected="arrays of numbers that numpy.savez wrote",
            fix="save them again as plain arrays, or export the recording as CSV",
        ) from error
    units = dict(names.values())
    table = nested_table(str(path), content, units, wanted)
    return replace(table, units={**table.units, **units})
