"""How a CSV is written: its encoding, what separates its cells, which line names the columns and which their units."""

from __future__ import annotations

import codecs
import csv
import re
from collections import Counter
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from itertools import chain

from rwn.errors import InputError
from rwn.recording import units
from rwn.recording.formats.csv_doubts import refuse_thousands, with_row_of_units
from rwn.recording.formats.scope import scope_block

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
_BLANKS = re.compile(r"[ ]+(?![ \[(])")
_ABOVE = 4  # rows of names, units and the like that may stand above the numbers
_LONGEST = 300  # characters of a cell with a name and a unit: nobody writes such, and matching takes their square
_JUDGED = 100  # lines from the end of the sample that tell how rows look


@dataclass(frozen=True, kw_only=True)
class Dialect:
    """`names` and `units` (None: not said) of the columns; `first`: lines above the first row of numbers.

    `called`: what messages call a line; a spreadsheet has rows.
    """

    delimiter: str
    names: tuple[str, ...]
    units: tuple[str | None, ...]
    first: int
    called: str = "line"


def encoding_of(start: bytes, where: object) -> str:
    """The encoding that the first bytes of a file speak for. Raises InputError for what is no text."""
    if start.startswith(codecs.BOM_UTF8):
        return "utf-8-sig"
    if start.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return "utf-16"
    zeros = [start[k::2].count(0) / max(len(start[k::2]), 1) for k in (0, 1)]
    if zeros[1] > 0.8 and zeros[0] < 0.1:
        return "utf-16-le"
    if zeros[0] > 0.8 and zeros[1] < 0.1:
        return "utf-16-be"
    if b"\0" in start:
        raise InputError(
            "this is not a text file",
            where=where,
            expected="CSV text",
            fix="export the recording as CSV, or give the file the ending of its format (.mat, .xlsx)",
        )
    return "utf-8"


def separated_by_blanks(lines: Sequence[str]) -> bool:
    """Whether runs of blanks, and nothing else, separate the cells of the first `lines` of a file."""
    rows = [line for line in lines if line.strip() and not line.startswith("#")]
    tail = rows[len(rows) // 2 :][-_JUDGED:]
    cells = [line.split() for line in tail]
    alone = not any(mark in line for line in tail for mark in ",;\t|\"")
    return bool(cells) and alone and len(cells[0]) > 1 and all(map(is_number, chain(*cells)))


def without_blanks(line: str) -> str:
    """A line whose cells blanks separate, with tabs between them; a unit in brackets stays with its name."""
    mark = "#" if line.startswith("#") else ""
    return mark + _BLANKS.sub("\t", line[len(mark) :].strip())


def dialect_of(lines: Sequence[str], wanted: Collection[str], where: str, called: str = "line") -> Dialect:
    """The dialect of the first `lines` of a file; `wanted` names tell a row of names from one of units.

    Raises InputError where no row of names is found, or columns are not told apart.
    """
    block = scope_block(lines)
    if block is not None:
        return Dialect(
            delimiter=block.delimiter, names=block.names, units=block.units, first=block.first, called=called
        )
    told = [(k, line) for k, line in enumerate(lines) if line.strip(" \t,;#")]
    if not told:
        raise InputError("the file is empty", where=where, expected="a header row and rows of numbers", fix=HOW)
    tail = [line for _, line in told[len(told) // 2 :] if not line.startswith("#")][-_JUDGED:]
    delimiter = max(",;\t|", key=lambda d: (_numbers_in(tail, d), _outside_brackets(told[-1][1]).count(d)))
    rows = [split(line, delimiter, where) for line in tail]
    width, numeric = _columns(rows)
    refuse_thousands(rows, where)
    if not numeric:
        return _without_numbers(told, delimiter, where, called)
    at = next(
        j for j, (_, line) in enumerate(told)
        if not line.startswith("#") and _is_data(split(line, delimiter, where), width, numeric)
    )  # fmt: skip
    above = _named_rows(told[:at], delimiter, width, where)
    if not above:
        return _without_header(told, at, delimiter, width, wanted, where, called)
    best = 0 if len(above) == 1 else max(range(len(above)), key=lambda j: _likely_names(above[j][1], j, wanted))
    (line, cells), below = above[best], [cells for _, cells in above[best + 1 :]]
    names, given = _header(cells, f"{where}, {called} {line}")
    if below:
        given = with_row_of_units(names, given, [_BRACKETS.sub(r"\1", cell) for cell in below[0]], where)
    return Dialect(delimiter=delimiter, names=names, units=tuple(given), first=told[at][0], called=called)


def _without_numbers(told: Sequence[tuple[int, str]], delimiter: str, where: str, called: str) -> Dialect:
    """A header that nothing readable follows."""
    first, line = next(((k, line) for k, line in told if not line.startswith("#")), told[0])
    names, given = _header(split(line, delimiter, where), f"{where}, {called} {first + 1}")
    return Dialect(delimiter=delimiter, names=names, units=tuple(given), first=first + 1, called=called)


def _without_header(
    told: Sequence[tuple[int, str]], at: int, delimiter: str, width: int, wanted: Collection[str], where: str,
    called: str,
) -> Dialect:  # fmt: skip
    """Columns called 1, 2, .. where the map names some of them so; else the reason why no row names them."""
    place, line = f"{where}, {called} {told[at][0] + 1}", told[at][1]
    names = tuple(str(j + 1) for j in range(width))
    if any(name in wanted for name in names):
        return Dialect(delimiter=delimiter, names=names, units=(None,) * width, first=told[at][0], called=called)
    rows = (split(line.lstrip("# "), delimiter, where) for _, line in reversed(told[:at]))
    above = next((row for row in rows if not any(map(is_number, row))), [])  # the same commas make rows of other widths
    if delimiter == "," and len(above) + 1 < width <= 2 * len(above):
        raise InputError(
            f"{width} values in {len(above)} columns: decimal commas between cells that commas separate",
            where=place,
            expected="decimal points, or cells separated by semicolons or tabs",
            fix="export with another separator, or with decimal points",
        )
    if any(name_of(cell) in wanted for cell in above):
        raise InputError(
            f"{width} values in {len(above)} columns",
            where=place,
            expected=f"one value for each of {', '.join(above)}",
            fix=f"name every column, or complete the {called}s",
        )
    raise InputError(
        f"no row names the columns: the first row of numbers begins with {split(line, delimiter, where)[0]}",
        where=place,
        expected="a header row of name [unit]",
        fix=f'{HOW}; or map columns by number: columns.speed = {{ source = "3", unit = "rpm" }} under [recording]',
    )


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


def _outside_brackets(line: str) -> str:
    return re.sub(r"\[[^\]]*\]", "", line)


def _numbers_in(lines: Sequence[str], delimiter: str) -> float:
    """How much of the lines are numbers, if cells are told apart so; 0 where there is one column only."""
    share = 0.0
    for line in lines:
        cells = line.replace('"', "").split(delimiter) if '"' not in line else split(line, delimiter, "")
        if len(cells) > 1:
            share += sum(map(is_number, cells)) / len(cells)
    return round(share, 6)


def _columns(rows: Sequence[Sequence[str]]) -> tuple[int, list[int]]:
    """How many cells most rows have, and which of them hold numbers."""
    width = Counter(map(len, rows)).most_common(1)[0][0] if rows else 0
    rows = [row for row in rows if len(row) == width]
    return width, [j for j in range(width) if 2 * sum(is_number(row[j]) for row in rows) > len(rows)]


def _is_data(cells: Sequence[str], width: int, numeric: Sequence[int]) -> bool:
    if len(cells) != width:
        return False
    return 2 * sum(is_number(cells[j]) for j in numeric) > len(numeric)


def _named_rows(
    told: Sequence[tuple[int, str]], delimiter: str, width: int, where: str
) -> list[tuple[int, list[str]]]:
    """Rows directly above the numbers with a cell for each column, with their lines, the topmost first."""
    rows: list[tuple[int, list[str]]] = []
    for k, line in reversed(told[-_ABOVE:]):
        cells = split(line.lstrip("# "), delimiter, where)
        cells = cells[:width] if len(cells) == width + 1 and not cells[-1] else cells
        if len(cells) == width:
            rows.insert(0, (k + 1, cells))
        elif not line.startswith("#"):
            break
    return rows


def _likely_names(cells: Sequence[str], j: int, wanted: Collection[str]) -> tuple[int, bool, int]:
    """The more, the likelier a row holds the names: wanted ones, or anything that is no unit."""
    only_units = all(len(cell) < 30 and units.is_unit(_BRACKETS.sub(r"\1", cell)) for cell in cells if cell)
    return sum(name_of(cell) in wanted for cell in cells), not only_units, -j


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


def _header(cells: Sequence[str], where: str) -> tuple[tuple[str, ...], list[str | None]]:
    names: list[str] = []
    given: list[str | None] = []
    for k, cell in enumerate(cells):
        try:
            name, unit = name_and_unit(cell)
        except ValueError as error:
            raise InputError(
                f"cannot read the column name '{cell}'", where=where, expected="name [unit]", fix=HOW
            ) from error
        names.append(name or f"column {k + 1}")
        given.append(unit)
    return tuple(names), given
