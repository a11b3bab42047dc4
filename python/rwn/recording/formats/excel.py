"""Spreadsheets of Excel and OpenDocument, read by python-calamine: the first sheet long enough for a recording."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from datetime import date, datetime, time, timedelta
from pathlib import Path

from rwn.errors import InputError
from rwn.recording.check import MIN_SAMPLES
from rwn.recording.formats.csv import read_lines
from rwn.recording.formats.extra import library
from rwn.recording.formats.table import Table

Rows = list[list[object]]

_ANY_DAY = datetime(1970, 1, 1)
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
        lines = ["\t".join(map(_cell, row)) for row in _table(sheets)]
    except Exception as error:  # calamine raises kinds of its own for what is no spreadsheet
        raise InputError(
            "the spreadsheet cannot be read",
            where=path,
            expected="a file of Excel or OpenDocument",
            fix="save it again, or export the sheet as CSV",
        ) from error
    return read_lines(str(path), iter([(0, lines)]), wanted, line="row")


def _table(sheets: Iterable[Rows]) -> Rows:
    """The first with rows enough for a recording (others say who made it); else the first that has two columns."""
    first: Rows = []
    for rows in sheets:
        if any(len(row) > 1 for row in rows):
            if len(rows) > MIN_SAMPLES:
                return rows
            first = first or rows
    return first


def _cell(value: object) -> str:
    """As it stands in a CSV; a day, a time of day and a duration as instants, which their differences are taken of."""
    if isinstance(value, timedelta):
        value = _ANY_DAY + value
    elif isinstance(value, time):
        value = datetime.combine(_ANY_DAY, value)
    elif isinstance(value, date) and not isinstance(value, datetime):  # an instant at midnight
        value = datetime.combine(value, time())
    if isinstance(value, datetime):
        return value.isoformat(timespec="microseconds")
    return repr(value) if isinstance(value, float) else " ".join(str(value).split())
