"""A cell of a CSV: where it ends, whether it holds a number, and the name and unit that it gives a column."""

from __future__ import annotations

import csv
import re

from rwn.errors import InputError

HOW = "write a first row such as: time [s],voltage [V],speed [rad/s]"
_NUMBER = re.compile(r"\s*[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?\s*|\s*[-+]?(nan|inf|infinity)\s*", re.IGNORECASE)
_UNIT_AFTER = (
    re.compile(r"\s*(?P<name>[^\[\]]*?)\s*\[\s*(?P<unit>[^\[\]]*?)\s*\]\s*"),  # speed [rpm]
    re.compile(r"\s*(?P<name>.*?\S)\s*\(\s*(?P<unit>[^()]*?)\s*\)\s*"),  # speed (rpm)
    re.compile(r"\s*(?P<name>.*?\S)\s+(?:/|in)\s+(?P<unit>\S+)\s*"),  # speed / rpm, speed in rpm
    re.compile(r"\s*(?P<name>[^\[\]]*?)(?P<unit>)\s*"),
)
_INDEXED = re.compile(r".*\S\[\d+\]")  # r0061[0]: of several, not a unit
_BRACKETS = re.compile(r"\s*[\[(]?\s*(.*?)\s*[\])]?\s*")
_LONGEST = 300  # characters of a cell with a name and a unit: nobody writes such, and matching takes their square


def split(line: str, delimiter: str, where: str) -> list[str]:
    """The cells of a line; quotes around a cell are taken off. Raises InputError."""
    try:
        return [cell.strip() for cell in next(csv.reader([line], delimiter=delimiter), [])]
    except csv.Error as error:
        raise InputError(
            f"a line cannot be split into cells ({error})", where=where, expected="rows of numbers", fix=HOW
        ) from error


def is_number(cell: str) -> bool:
    """Whether a cell holds a number, with a decimal point or a decimal comma."""
    return _NUMBER.fullmatch(cell.replace(",", ".")) is not None


def bare_unit(cell: str) -> str:
    """The text of a cell in a row of units, without the brackets that may be around it."""
    return _BRACKETS.sub(r"\1", cell)


def name_of(cell: str) -> str:
    """The name in a header's cell, whatever is wrong with its unit."""
    try:
        return name_and_unit(cell)[0]
    except ValueError:
        return cell


def name_and_unit(cell: str) -> tuple[str, str | None]:
    """`speed [rpm]`, `speed (rpm)`, `speed / rpm` or `speed in rpm` as name and unit (None: not said).

    Raises ValueError where brackets are left open.
    """
    if len(cell) > _LONGEST or _INDEXED.fullmatch(cell):
        return cell, None
    for form in _UNIT_AFTER:
        match = form.fullmatch(cell)
        if match is not None:
            return match["name"], match["unit"] or None
    raise ValueError(cell)
