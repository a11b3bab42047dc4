"""CSV with one header row of `name [unit]`; comma, or semicolon or tab and then decimal comma too."""

from __future__ import annotations

import csv
import re
from collections.abc import Collection, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rwn.errors import InputError
from rwn.recording.formats.table import MAX_SAMPLES, Table, too_long

_HEADER = re.compile(r"\s*(?P<name>[^\[\]]*?)\s*(?:\[\s*(?P<unit>[^\[\]]*?)\s*\])?\s*")
_HOW = "write a first row such as: time [s],voltage [V],speed [rad/s]"


def read_csv(path: Path, wanted: Collection[str] = ()) -> Table:
    """The `wanted` columns that exist; `units` names all. Raises InputError with the line that is wrong."""
    lines = _decode(path).splitlines()
    first = next((k for k, line in enumerate(lines) if line.strip() and not line.startswith("#")), None)
    if first is None:
        raise InputError(
            "the file is empty", where=path, expected="a header row and rows of numbers", fix=_HOW
        )
    delimiter = max(",;\t", key=re.sub(r"\[[^\]]*\]", "", lines[first]).count)
    names, units = _header(
        next(csv.reader([lines[first]], delimiter=delimiter)), where=f"{path}, line {first + 1}"
    )
    rows = [(k + 1, line) for k, line in enumerate(lines[first + 1 :], first + 1) if line.strip()]
    if len(rows) > MAX_SAMPLES:
        raise too_long(path, len(rows))
    if delimiter != ",":
        rows = [(k, line.replace(",", ".")) for k, line in rows]
    used = [j for j, name in enumerate(names) if name in wanted]
    values = _numbers(path, rows, names, used, delimiter)
    columns = {names[j]: np.ascontiguousarray(values[:, k]) for k, j in enumerate(used)}
    return Table(path=path, columns=columns, units=units, row=lambda k: f"line {rows[k][0]}")


def _decode(path: Path) -> str:
    raw = path.read_bytes()
    if b"\0" in raw[:65536]:
        raise InputError(
            "this is not a text file",
            where=path,
            expected="CSV text",
            fix="export the recording as CSV, or give it its own ending (.mat)",
        )
    for encoding in ("utf-8-sig", "cp1252"):
        try:
            return raw.decode(encoding)
        except UnicodeDecodeError:
            continue
    raise InputError(
        "this is not a text file", where=path, expected="CSV text in UTF-8", fix="save it as UTF-8"
    )


def _header(cells: Sequence[str], *, where: str) -> tuple[list[str], dict[str, str | None]]:
    units: dict[str, str | None] = {}
    for cell in cells:
        match = _HEADER.fullmatch(cell)
        if match is None:
            raise InputError(
                f"cannot read the column name '{cell}'", where=where, expected="name [unit]", fix=_HOW
            )
        name = match["name"]
        if _is_number(name):
            raise InputError(
                f"the first row holds the number {name}, not a name",
                where=where,
                expected="a header row of name [unit]",
                fix=_HOW,
            )
        if name in units:
            raise InputError(
                f"two columns are called '{name}'",
                where=where,
                expected="each name once",
                fix="rename or remove one of them",
            )
        units[name] = match["unit"]
    return list(units), units


def _numbers(
    path: Path, rows: list[tuple[int, str]], names: Sequence[str], used: Sequence[int], delimiter: str
) -> NDArray[np.float64]:
    for line, text in rows:
        if text.count(delimiter) != len(names) - 1:
            raise InputError(
                f"{text.count(delimiter) + 1} values in {len(names)} columns",
                where=f"{path}, line {line}",
                expected=f"one value for each of {', '.join(names)}",
                fix="complete the line or remove it",
            )
    if not rows or not used:
        return np.empty((len(rows), len(used)))
    try:
        return np.loadtxt(
            [text for _, text in rows], delimiter=delimiter, ndmin=2, comments=None, usecols=used
        )
    except ValueError as error:
        raise _first_bad_cell(path, rows, names, used, delimiter) from error


def _first_bad_cell(
    path: Path, rows: list[tuple[int, str]], names: Sequence[str], used: Sequence[int], delimiter: str
) -> InputError:
    for line, text in rows:
        cells = text.split(delimiter)
        for j in used:
            cell = cells[j].strip()[:40]
            if not _is_number(cell):
                what = (
                    f"'{cell}' in column '{names[j]}' is not a number"
                    if cell
                    else f"column '{names[j]}' is empty"
                )
                return InputError(
                    what,
                    where=f"{path}, line {line}",
                    expected="a number",
                    fix="complete the line or remove it",
                )
    return InputError("the rows cannot be read as numbers", where=path, expected="rows of numbers", fix=_HOW)


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
