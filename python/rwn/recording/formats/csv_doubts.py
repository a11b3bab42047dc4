"""What a CSV says in two ways: units beside a name and in rows, points and commas for decimals or for thousands."""

from __future__ import annotations

import csv
import re
from collections.abc import Sequence

from rwn.errors import InputError
from rwn.recording import units

_OTHER = {".": ",", ",": "."}
_THOUSANDS = {mark: re.compile(rf"\s*[+-]?[1-9]\d{{0,2}}{re.escape(mark)}\d{{3}}\s*") for mark in ".,"}


def with_row_of_units(
    names: Sequence[str], given: Sequence[str | None], row: Sequence[str], where: str
) -> list[str | None]:  # fmt: skip
    """The units that are `given` already, beside the names or in another row, and for the others those of a row.

    Raises InputError where a column has one of each, and they differ.
    """
    for name, unit, other in zip(names, given, row, strict=True):
        if unit and other and units.is_unit(other) and units.is_unit(unit) and not units.same(unit, other, where=where):
            raise InputError(
                f"column '{name}' is in {unit} and, by a row of units, in {other}",
                where=where,
                expected="one unit for each column",
                fix="correct the one that is wrong",
            )
    return [unit or other or None for unit, other in zip(given, row, strict=True)]


class Marks:
    """What the points and commas in the cells of a file mark: decimals, as one that is no group of thousands shows."""

    def __init__(self, names: Sequence[str], columns: Sequence[int]) -> None:
        self.names, self.columns = names, columns
        self.decimal: dict[int, str] = {}  # column -> its decimal mark, where a cell shows it
        self.unsure: dict[tuple[int, str], str] = {}  # column and mark -> a cell in which it may mark thousands
        self.plain: set[int] = set()  # columns with cells without a mark

    def see(self, lines: Sequence[str], delimiter: str, where: str) -> None:
        """Some lines, of numbers in each column. Raises InputError where a column has decimals of both marks."""
        text = "\n".join(lines)
        if delimiter == "," and '"' not in text:
            return  # no comma is a mark
        there = {mark for mark in ".," if mark in text}
        doubtful = [k for k in self.columns if there - {self.decimal.get(k, "")}]
        rows = list(csv.reader(lines, delimiter=delimiter)) if doubtful else []
        for column in doubtful:
            for row in rows:
                cell = row[column]
                mark = "," if "," in cell else "." if "." in cell else ""
                if mark:
                    self._see(column, mark, cell, where)
                    if not there - {self.decimal.get(column, "")}:
                        break
                else:
                    self.plain.add(column)

    def _see(self, column: int, mark: str, cell: str, where: str) -> None:
        known = self.decimal.get(column)
        if known is None and _THOUSANDS[mark].fullmatch(cell):
            self.unsure.setdefault((column, mark), cell)
        elif known is None:
            self.decimal[column] = known = mark
        before = self.unsure.get((column, _OTHER[known])) if known else None
        if known and (mark != known or before):
            raise self._unclear(column, before or cell, where)

    def refuse_thousands(self, where: str) -> None:
        """Raises InputError where marks may be of thousands: no cell shows them as decimal, and others have another."""
        shown = set(self.decimal.values())
        for (column, mark), cell in self.unsure.items():
            if column in self.decimal or mark in shown:
                continue
            if shown or (mark == "," and column in self.plain):
                raise self._unclear(column, cell, where)

    def _unclear(self, column: int, cell: str, where: str) -> InputError:
        mark = "point" if "." in cell else "comma"
        return InputError(
            f"'{cell.strip()}' in column '{self.names[column]}' may be in thousands or have a decimal {mark}",
            where=where,
            expected="one way of writing numbers",
            fix="export without marks of thousands, with one decimal mark in all columns",
        )
