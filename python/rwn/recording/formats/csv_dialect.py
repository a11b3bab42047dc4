"""How a CSV is written: its encoding, what separates its cells, which line names the columns and which their units."""

from __future__ import annotations

import codecs
import re
from collections import Counter
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from itertools import chain, takewhile

from rwn.errors import InputError
from rwn.recording import units
from rwn.recording.formats.csv_cells import HOW, bare_unit, is_number, name_and_unit, name_of, split
from rwn.recording.formats.csv_doubts import with_row_of_units
from rwn.recording.formats.scope import scope_block

_BLANKS = re.compile(r"[ ]+(?![ \[(])")
_DIGITS = re.compile(r"[-+]?[.,]?\d")
_ABOVE = 4  # rows of names, units and the like that may stand above the numbers, and rows of numbers above the names
_JUDGED = 100  # lines from the end of the sample that tell how rows look

Row = tuple[int, list[str]]  # number of its line from 1, its cells


@dataclass(frozen=True, kw_only=True)
class Dialect:
    """`names` and `units` (None: not said) of the columns; `first`: lines above the first row of numbers.

    `called`: what messages call a line; a spreadsheet has rows. `passed_over`: whole rows of numbers above the names.
    """

    delimiter: str
    names: tuple[str, ...]
    units: tuple[str | None, ...]
    first: int
    called: str = "line"
    passed_over: int = 0


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
    if not numeric:
        return _without_numbers(told, delimiter, where, called)
    above, at, passed_over = _heading(told, delimiter, width, numeric, wanted, where)
    if not above:
        return _without_header(told, at, delimiter, width, wanted, where, called)
    best = 0 if len(above) == 1 else max(range(len(above)), key=lambda j: _likely_names(above[j][1], j, wanted))
    (line, cells), below = above[best], [cells for _, cells in above[best + 1 :]]
    names, given = _header(cells, f"{where}, {called} {line}")
    if below:
        given = with_row_of_units(names, given, list(map(bare_unit, below[0])), where)
    for _, other in above:
        if other is not cells and _only_units(other):  # of several, none may contradict
            with_row_of_units(names, given, list(map(bare_unit, other)), where)
    return Dialect(
        delimiter=delimiter, names=names, units=tuple(given), first=told[at][0], called=called, passed_over=passed_over
    )


def _heading(
    told: Sequence[tuple[int, str]], delimiter: str, width: int, numeric: Sequence[int], wanted: Collection[str],
    where: str,
) -> tuple[list[Row], int, int]:  # fmt: skip
    """The rows of names, units and the like, which of the `told` lines is the first row of numbers below them, and how
    many whole rows of numbers stand above.

    The row with most of the wanted names heads the columns, whatever an instrument writes above it. Where none has any,
    the rows directly above the first that is all numbers do. Without such rows: none, and the first row of numbers.
    """
    rows = {j: split(line, delimiter, where) for j, (_, line) in enumerate(told) if not line.startswith("#")}
    data = [j for j, cells in rows.items() if _numbers_of(cells, width, numeric) > 0.5]
    begun = [j for j, cells in rows.items() if _begins_data(cells, width)]
    known = {
        j: sum(name_of(cell) in wanted for cell in cells)
        for j, cells in rows.items()
        if len(cells) == width and _may_name(cells, width, numeric, wanted)
    }
    best = max(known, key=lambda j: (known[j], -j), default=0)
    whole = [j for j in data if all(is_number(rows[j][k]) or not rows[j][k] for k in numeric)]
    over = [j for j in whole if j < best]
    beneath = known.get(best) and len(over) <= _ABOVE and any(j > best for j in data)
    for at in [*[j for j in begun if beneath and j > best][:1], *whole[:1]]:
        above = _rows_above(told[:at], delimiter, width, where)
        names = [*takewhile(lambda row: _may_name(row[1], width, numeric, wanted), reversed(above))]
        if 0 < len(names) < len(above) and all(_only_units(cells) for _, cells in names):
            names = above[::-1][: len(names) + 1]  # names stand above them, be they numbers
        if names:
            return names[::-1], at, len(over) if beneath else 0
    first = next((j for j in begun if len(rows[j]) == width), data[0])
    return _rows_above(told[:first], delimiter, width, where), first, 0


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


def _numbers_of(cells: Sequence[str], width: int, numeric: Sequence[int]) -> float:
    """The share of the columns of numbers in which a row has one; 0 where it has another number of cells."""
    return sum(is_number(cells[j]) for j in numeric) / len(numeric) if len(cells) == width else 0.0


def _may_name(cells: Sequence[str], width: int, numeric: Sequence[int], wanted: Collection[str]) -> bool:
    """Whether a row has a number in none of the columns of numbers, or names a wanted one that is not called by one."""
    named = any(not is_number(cell) and name_of(cell) in wanted for cell in cells)
    return named or _numbers_of(cells, width, numeric) == 0.0


def _begins_data(cells: Sequence[str], width: int) -> bool:
    """Whether a cell begins as a number does, most where others are missing; not in a row of units, such as 1/min."""
    begun = sum(_DIGITS.match(cell) is not None or is_number(cell) for cell in cells)  # also nan
    filled = sum(map(bool, cells))
    return begun > (0 if len(cells) == width else filled / 2) and not (begun < filled and _only_units(cells))


def _only_units(cells: Sequence[str]) -> bool:
    return all(len(cell) < 30 and units.is_unit(bare_unit(cell)) for cell in cells if cell)


def _rows_above(
    told: Sequence[tuple[int, str]], delimiter: str, width: int, where: str
) -> list[Row]:
    """Rows directly above the numbers with a cell for each column, with their lines, the topmost first."""
    rows: list[Row] = []
    for k, line in reversed(told[-_ABOVE:]):
        cells = split(line.lstrip("# "), delimiter, where)
        cells = cells[:width] if len(cells) == width + 1 and not cells[-1] else cells
        if len(cells) == width:
            rows.insert(0, (k + 1, cells))
        elif not line.startswith("#"):
            break
    return rows


def _likely_names(cells: Sequence[str], j: int, wanted: Collection[str]) -> tuple[int, bool, bool, int]:
    """The more, the likelier a row holds the names: wanted ones, or a cell for most columns that is no unit."""
    known, most = sum(name_of(cell) in wanted for cell in cells), 2 * sum(map(bool, cells)) > len(cells)
    return known, most, not _only_units(cells), -j


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
