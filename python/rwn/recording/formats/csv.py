"""CSV as instruments and spreadsheets write it, read in blocks so that length costs little memory."""

from __future__ import annotations

import csv
from bisect import bisect_right
from collections.abc import Collection, Iterator, Mapping, Sequence
from itertools import chain
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rwn.errors import InputError
from rwn.recording.formats.csv_cells import HOW, is_number, split
from rwn.recording.formats.csv_dialect import Dialect, dialect_of, encoding_of, separated_by_blanks, without_blanks
from rwn.recording.formats.csv_doubts import Marks
from rwn.recording.formats.stamps import Stamps, instant
from rwn.recording.formats.table import MAX_SAMPLES, Table, refuse_doubles, too_long

BLOCK = 2**20  # characters that are read at once, and the longest line
_QUOTE = '"'
_NO_ROW = ("#", "EOF")  # comments, and what TwinCAT Scope ends its exports with
_SAMPLE = 2**18  # characters that the dialect is told from

Array = NDArray[np.float64]
Block = tuple[int, list[str]]  # number of its first line from 0, its lines


def read_csv(path: Path, wanted: Collection[str] = ()) -> Table:
    """The `wanted` columns that exist; `units` names all. Raises InputError with the line that is wrong.

    Memory: the wanted columns twice (8 bytes a number), and a block of text.
    """
    with path.open("rb") as file:
        encoding = encoding_of(file.read(2**16), path)
    for tried in (encoding, "cp1252"):
        try:
            return read_lines(str(path), _blocks(path, tried), wanted)
        except UnicodeDecodeError:
            continue
    raise InputError(
        "this is not a text file", where=path, expected="CSV text in UTF-8", fix="save it as UTF-8"
    )


def read_lines(where: str, blocks: Iterator[Block], wanted: Collection[str], *, line: str = "line") -> Table:
    """The `wanted` columns of lines of text in blocks; `line`: what messages call one. Raises InputError."""
    first = next(blocks, (0, []))
    if separated_by_blanks(_sample(first[1])):
        first, blocks = _tabbed(first), map(_tabbed, blocks)
    dialect = dialect_of(_sample(first[1]), wanted, where, line)
    names = dialect.names
    used = [j for j, name in enumerate(names) if name in wanted]
    refuse_doubles(where, names, wanted)
    parts: list[list[Array]] = [[] for _ in used]
    starts: list[int] = []  # first row of each block, and the lines (from 1) of its rows
    numbers: list[Sequence[int]] = []
    rows = 0
    stamps: dict[int, Stamps] | None = None
    marks: Marks | None = None
    for at, lines in chain([first], blocks):
        skipped = max(dialect.first - at, 0)
        numbered, kept = _rows(lines, at + skipped, skipped)
        if not kept:
            continue
        stamps = _stamps(kept, dialect, used, where) if stamps is None else stamps
        values = _numbers(numbered, kept, dialect, used, where, stamps)
        marks = marks or Marks(names, [j for j in used if j not in stamps])
        marks.see(kept, dialect.delimiter, f"{where}, {line} {numbered[0]} and below")
        starts.append(rows)
        numbers.append(numbered)
        rows += len(kept)
        if rows > MAX_SAMPLES:
            raise too_long(where, rows)
        for part, column in zip(parts, values.T, strict=True):
            part.append(np.ascontiguousarray(column))
    if marks is not None:
        marks.refuse_thousands(where)
    columns = {}
    for j in used:
        part = parts.pop(0)  # one column after the other, so that two copies of one alone exist at a time
        columns[names[j]] = np.concatenate(part) if part else np.empty(0)
    units = dict(zip(names, dialect.units, strict=True)) | {names[j]: "s" for j in stamps or ()}
    over = dialect.passed_over
    return Table(
        where=where, columns=columns, units=units, row=lambda k: f"{line} {_line(starts, numbers, k)}",
        notes=(f"{where}: {over} {line}s of numbers above the names are left out",) if over else (),
    )  # fmt: skip


def _stamps(lines: Sequence[str], dialect: Dialect, used: Sequence[int], where: str) -> dict[int, Stamps]:
    """The used columns that hold instants, by their place; the first row tells."""
    cells = split(lines[0], dialect.delimiter, where)
    begun = {j: instant(cells[j]) for j in used if j < len(cells)}
    return {j: Stamps(first) for j, first in begun.items() if first is not None}


def _tabbed(block: Block) -> Block:
    return block[0], list(map(without_blanks, block[1]))


def _line(starts: Sequence[int], numbers: Sequence[Sequence[int]], row: int) -> int:
    block = bisect_right(starts, row) - 1
    return numbers[block][row - starts[block]]


def _blocks(path: Path, encoding: str) -> Iterator[Block]:
    """The lines of a file in blocks, each with the number of its first line. Raises InputError."""
    rest, at = "", 0
    with path.open(encoding=encoding) as file:
        while text := file.read(BLOCK):
            whole, end, rest = (rest + text).rpartition("\n")
            if not end and len(rest) >= BLOCK:
                raise InputError(
                    f"the line is longer than {BLOCK} characters",
                    where=f"{path}, line {at + 1}",
                    expected="a row of a few numbers in each line",
                    fix="export the recording as CSV",
                )
            if end:
                lines = whole.split("\n")
                yield at, lines
                at += len(lines)
    if rest:
        yield at, [rest]


def _sample(lines: Sequence[str]) -> list[str]:
    """The first lines, as many as tell the dialect."""
    taken, size = 0, 0
    while taken < len(lines) and (size < _SAMPLE or taken < 2):
        size += len(lines[taken]) + 1
        taken += 1
    return list(lines[:taken])


def _rows(lines: list[str], at: int, skipped: int) -> tuple[Sequence[int], list[str]]:
    """The lines that are rows, blank ones and comments left out, with their numbers from 1."""
    kept = lines[skipped:] if skipped else lines
    numbers: Sequence[int] = range(at + 1, at + 1 + len(kept))
    if all(map(str.strip, kept)) and not any(line.startswith(_NO_ROW) for line in kept):
        return numbers, kept
    pairs = [(k, line) for k, line in zip(numbers, kept, strict=True) if line.strip() and not line.startswith(_NO_ROW)]
    return [k for k, _ in pairs], [line for _, line in pairs]


def _numbers(
    numbers: Sequence[int], lines: list[str], dialect: Dialect, used: Sequence[int], where: str,
    stamps: Mapping[int, Stamps],
) -> Array:
    """The values (rows, columns) of the used columns."""
    delimiter, width = dialect.delimiter, len(dialect.names)
    quoted = any(_QUOTE in line for line in lines)
    try:
        rows = list(csv.reader(lines, delimiter=delimiter)) if quoted else None
    except csv.Error as error:
        raise InputError(
            f"the rows cannot be split into cells ({error})",
            where=f"{where}, {dialect.called} {numbers[0]} and below",
            expected="rows of numbers",
            fix="close the quotes, or export without them",
        ) from error
    widths = [len(row) for row in rows] if rows is not None else [line.count(delimiter) + 1 for line in lines]
    if rows is not None and len(rows) != len(lines):
        quotes = [line.count(_QUOTE) for line in lines]
        odd = next((k for k, n in enumerate(quotes) if n % 2), next(k for k, n in enumerate(quotes) if n))
        raise InputError(
            "a quote is left open",
            where=f"{where}, {dialect.called} {numbers[odd]}",
            expected="quotes in pairs, each within its row",
            fix="close the quote; remove line breaks within cells",
        )
    if set(widths) - {width}:
        k = next(k for k, w in enumerate(widths) if w != width)
        raise InputError(
            f"{widths[k]} values in {width} columns",
            where=f"{where}, {dialect.called} {numbers[k]}",
            expected=f"one value for each of {', '.join(dialect.names)}",
            fix=f"complete the {dialect.called} or remove it",
        )
    if not used:
        return np.empty((len(lines), 0))
    plain, columns = lines, list(used)
    if rows is not None:
        plain, columns = ["\t".join(row[j].replace(",", ".") for j in used) for row in rows], list(range(len(used)))
    elif delimiter != ",":
        plain = [line.replace(",", ".") for line in lines]
    try:
        place = {j: k for k, j in enumerate(used)} if rows is not None else {j: j for j in used}
        return np.loadtxt(
            plain, delimiter="\t" if quoted else delimiter, ndmin=2, comments=None, usecols=columns,
            converters={place[j]: stamp.seconds for j, stamp in stamps.items()}, encoding=None,
        )  # fmt: skip
    except ValueError as error:
        cells = rows or [line.split(delimiter) for line in lines]
        raise _first_bad_cell(numbers, cells, dialect, used, where, stamps) from error


def _first_bad_cell(
    numbers: Sequence[int], rows: Sequence[Sequence[str]], dialect: Dialect, used: Sequence[int], where: str,
    stamps: Mapping[int, Stamps],
) -> InputError:
    called = dialect.called
    for line, row in zip(numbers, rows, strict=True):
        for j in used:
            cell, name = row[j].strip(), dialect.names[j]
            if j in stamps and instant(cell) is None:
                return InputError(
                    f"'{cell[:40]}' in column '{name}' is no instant", where=f"{where}, {called} {line}",
                    expected="such as 2024-01-01T12:00:00.001, as in the first row",
                    fix=f"correct it or remove the {called}",
                )  # fmt: skip
            if j in stamps:
                continue
            if not is_number(cell) or (dialect.delimiter != "," and cell.count(",") + cell.count(".") > 1):
                what = f"'{cell[:40]}' in column '{name}' is not a number" if cell else f"column '{name}' is empty"
                mend = f"correct it, or remove the {called}" if cell else f"complete the {called} or remove it"
                separated = is_number(cell.replace(",", "").replace(".", "").replace(" ", "").replace("_", ""))
                return InputError(
                    what,
                    where=f"{where}, {called} {line}",
                    expected="a number without separators of thousands" if separated else "a number",
                    fix="export without them" if separated else mend,
                )
    return InputError("the rows cannot be read as numbers", where=where, expected="rows of numbers", fix=HOW)
