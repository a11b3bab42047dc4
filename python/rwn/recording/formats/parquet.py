"""Apache Parquet, read by pyarrow: the wanted columns only."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace
from pathlib import Path
from typing import Any

from rwn.errors import InputError
from rwn.recording.formats.arrow import unit_of_field
from rwn.recording.formats.extra import library
from rwn.recording.formats.frame import name_and_unit_of
from rwn.recording.formats.table import MAX_SAMPLES, Table, refuse_doubles, table_of, too_long
from rwn.recording.signals import TIME

_TIMES = ("timestamp", "duration")  # kinds of Arrow


def read_parquet(path: Path, wanted: Collection[str] = ()) -> Table:
    """The `wanted` columns; units from names, `speed [rpm]`, or a field's metadata (`unit` or `units`).

    Raises InputError for a file that is none.
    """
    parquet = library("pyarrow.parquet", "parquet", path)
    try:
        file = parquet.ParquetFile(path)
        schema, rows = file.schema_arrow, _rows(file.metadata)
        if rows > MAX_SAMPLES:
            raise too_long(str(path), rows)
        told = {field.name: name_and_unit_of(_named(field)) for field in schema}
        refuse_doubles(str(path), [name for name, _ in told.values()], wanted)
        content = file.read(columns=[column for column, (name, _) in told.items() if name in wanted])
    except InputError:
        raise
    except OSError:
        raise
    except Exception as error:  # pyarrow raises many kinds for what is no Parquet
        raise InputError(
            "the file is not Parquet, or it is damaged",
            where=path,
            expected="a complete Parquet file",
            fix="write it again, or export the recording as CSV",
        ) from error
    units = {name: unit or unit_of_field(schema.field(column)) for column, (name, unit) in told.items()}
    arrays = {name: None for name, _ in told.values()}
    arrays |= {told[column][0]: content.column(column).to_numpy() for column in content.column_names}
    table = table_of(str(path), arrays, units, wanted)
    return replace(table, row=lambda k: f"row {k + 1}")


def _rows(metadata: Any) -> int:
    """How many rows a file has, as its groups say too: pyarrow sets aside as much memory as a group says it takes.

    Raises ValueError where they say otherwise.
    """
    groups = sum(metadata.row_group(k).num_rows for k in range(metadata.num_row_groups))
    if groups != metadata.num_rows:
        raise ValueError(f"{metadata.num_rows} rows in groups of {groups}")
    return int(groups)


def _named(field: Any) -> str:
    """Its name; pandas calls an index that has none by its place: where it holds instants it is the time."""
    unnamed = field.name == "__index_level_0__" and str(field.type).startswith(_TIMES)
    return TIME.name if unnamed else str(field.name)
