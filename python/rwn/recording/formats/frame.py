"""Tables in Python: frames of pandas, polars and what else narwhals knows, datasets of xarray, dictionaries."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from typing import Any

import numpy as np

from rwn.errors import InputError
from rwn.recording.formats.arrow import unit_of_field
from rwn.recording.formats.csv_cells import name_and_unit
from rwn.recording.formats.table import Table, refuse_doubles, table_of


def is_frame(source: Any) -> bool:
    """Whether it is a frame that narwhals knows."""
    from narwhals.stable.v1 import dependencies

    return bool(dependencies.is_into_dataframe(source) or dependencies.is_polars_lazyframe(source))


def table_of_object(source: Any, wanted: Collection[str]) -> Table:
    """The `wanted` columns of a table in Python. Raises InputError for what is no table."""
    where = f"the {type(source).__name__}"
    if is_frame(source):
        found = list(columns_of_frame(source))
    elif hasattr(source, "data_vars") and hasattr(source, "coords"):
        said = [(*name_and_unit_of(str(name)), variable) for name, variable in source.variables.items()]
        found = [(name, variable.values, unit or variable.attrs.get("units")) for name, unit, variable in said]
    elif isinstance(source, Mapping):
        told = [(*name_and_unit_of(str(name)), values) for name, values in source.items()]
        found = [(name, values, unit) for name, unit, values in told]
    else:
        raise InputError(
            f"a recording cannot be read from {where}",
            where="recording",
            expected="a path, a Recording, a frame of pandas or polars, an xarray.Dataset or a dictionary of arrays",
            fix='pass for instance {"time [s]": t, "voltage [V]": u, "speed [rpm]": w}',
        )
    refuse_doubles(where, [name for name, _, _ in found], wanted)
    return table_of(where, {n: values for n, values, _ in found}, {n: unit for n, _, unit in found}, wanted)


def columns_of_frame(frame: Any) -> Iterator[tuple[str, Any, str | None]]:
    """Name, values and unit of each column, and of an index that has a name or holds instants.

    A unit is in the column's name, `speed [rpm]`, in the frame's attrs: `units` by name, or MATLAB's lists, or in the
    metadata of a field of pyarrow.
    """
    from narwhals import stable

    if stable.v1.dependencies.is_polars_lazyframe(frame):
        frame = frame.collect()
    attrs = getattr(frame, "attrs", {})
    listed = attrs.get("VariableUnits") or attrs.get("varUnits") or ()
    units = attrs.get("units")
    given: Mapping[str, str] = units if isinstance(units, Mapping) else {}
    index: Any = getattr(frame, "index", None)
    if getattr(getattr(index, "dtype", None), "kind", "") in ("m", "M"):
        plain = index.tz_convert(None) if getattr(index, "tz", None) is not None else index
        yield name_and_unit_of(str(index.name or "time"))[0], np.asarray(plain), "s"
    elif getattr(index, "name", None):
        name, unit = name_and_unit_of(str(index.name))
        yield name, np.asarray(index), unit or given.get(name)
    names = None
    if hasattr(frame, "set_axis"):  # pandas, where a name may be a number, several, or there twice
        names = list(map(_joined, frame.columns))
        frame = frame.set_axis([str(k) for k in range(len(names))], axis=1)
    wrapped = stable.v1.from_native(frame, eager_only=True)
    fields = [unit_of_field(field) for field in frame.schema] if stable.v1.dependencies.is_pyarrow_table(frame) else ()
    listed = fields or listed
    for k, (column, own) in enumerate(zip(names or wrapped.columns, wrapped.columns, strict=True)):
        name, unit = name_and_unit_of(column)
        values = wrapped[own].to_numpy()
        unit = unit or given.get(column) or given.get(name) or (listed[k] if k < len(listed) else None)
        yield name, values, unit


def _joined(name: object) -> str:
    """A column's name; one of several levels as what is nested has it."""
    return ".".join(map(str, name)) if isinstance(name, tuple) else str(name)


def name_and_unit_of(name: str) -> tuple[str, str | None]:
    """Name and unit (None: not said) of a column called `speed [rpm]`; all of it is the name if brackets stay open."""
    try:
        return name_and_unit(name)
    except ValueError:
        return name, None
