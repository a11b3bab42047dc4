"""Spreadsheets of Excel and OpenDocument, read by python-calamine: the first sheet that holds a table."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path

from rwn.errors import InputError
from rwn.recording.formats.csv import read_lines
from rwn.recording.formats.extra import library
from rwn.recording.formats.table import Table

MAX_BYTES = 256 * 2**20  # a spreadsheet is unpacked whole


def read_excel(path: Path, wanted: Collection[str] = ()) -> Table:
    """The `wanted` columns; headers, units and text above them are told as in a CSV. Raises InputError."""
    calamine = library("python_calamine", "excel", path)
    if path.stat().st_size > MAX_BYTES:
        raise InputError(
            f"the file has {path.stat().st_size >> 20} MB",
            where=path,
            expected=f"at most {MAX_BYTES >> 20} MB",
            fix="export the sheet as CSV",
        )
    try:
        book = calamine.CalamineWorkbook.from_path(str(path))
        sheets = (book.get_sheet_by_name(name).to_python(skip_empty_area=False) for name in book.sheet_names)
        rows: list[list[object]] = next((rows for rows in sheets if any(len(row) > 1 for row in rows)), [])
    except Exception as error:  # calamine raises kinds of its own for what is no spreadsheet
        raise InputError(
            "the spreadsheet cannot be read",
            where=path,
            expected="a file of Excel or OpenDocument",
            fix="save it again, or export the sheet as CSV",
        ) from error
    lines = ["\t".join(_cell(value) for value in row) for row in rows]
    return read_lines(str(path), iter([(0, lines)]), wanted, line="row")


def _cell(value: object) -> str:
    return repr(value) if isinstance(value, float) else " ".join(str(value).split())
