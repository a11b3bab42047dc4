"""What a CSV says in two ways: units beside a name and below it, points that are decimal or mark thousands."""

from __future__ import annotations

import re
from collections.abc import Sequence

from rwn.errors import InputError
from rwn.recording import units

_THOUSANDS = re.compile(r"\s*[+-]?[1-9]\d{0,2}\.\d{3}\s*")
_DECIMAL_COMMA = re.compile(r"\s*[+-]?\d*,\d+\s*")


def with_row_of_units(
    names: Sequence[str], given: Sequence[str | None], below: Sequence[str], where: str
) -> list[str | None]:  # fmt: skip
    """The units that stand beside the names, and for the others those of the row below.

    Raises InputError where a name has one of each, and they differ.
    """
    for name, unit, other in zip(names, given, below, strict=True):
        if unit and other and units.is_unit(other) and units.is_unit(unit) and not units.same(unit, other, where=where):
            raise InputError(
                f"column '{name}' is in {unit} by its name and in {other} by the row of units below",
                where=where,
                expected="one unit for each column",
                fix="correct the one that is wrong",
            )
    return [unit or other or None for unit, other in zip(given, below, strict=True)]


def refuse_thousands(rows: Sequence[Sequence[str]], where: str) -> None:
    """Raises InputError where points may mark thousands: all of a column's do, and other cells have decimal commas."""
    if not any(_DECIMAL_COMMA.fullmatch(cell) for row in rows for cell in row):
        return
    for k in range(max(map(len, rows))):
        pointed = [row[k] for row in rows if k < len(row) and "." in row[k]]
        if pointed and all(map(_THOUSANDS.fullmatch, pointed)):
            raise InputError(
                f"'{pointed[0].strip()}' may be in thousands or have a decimal point: other cells have decimal commas",
                where=where,
                expected="one way of writing numbers",
                fix="export without marks of thousands, or with decimal points alone",
            )
