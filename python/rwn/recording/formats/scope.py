"""The block of names, sample times and units above the numbers of a TwinCAT Scope export.

Each group of channels begins with a column of times in ms, headed `Name`; a group is of the channels with one sample
time, or of a single one. An export with the plainest header has the names alone. Sources: Beckhoff Infosys, TE13xx
Scope View, Export to csv; the readers pytcs (CagtayFabry) and of the DLR's shepard for groups of one channel.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from typing import NamedTuple

_NAMES, _STEP, _UNIT, _STARTED = "Name", "SampleTime[ms]", "Unit", "Starttime of export"
_LINES = 60  # within which the block ends


class Block(NamedTuple):
    """`names` and `units` (None: not said) of the columns; `first`: lines above the first row of numbers."""

    delimiter: str
    names: tuple[str, ...]
    units: tuple[str | None, ...]
    first: int


def scope_block(lines: Sequence[str]) -> Block | None:
    """The block above the numbers; None where there is none.

    The times of the sample time with most channels are called `time`, those of later groups with the same instants
    `time@3`. Channels whose rows are of other instants are called `NAME@5ms` by their sample time, or `NAME@+0.5ms` by
    how much later they are.
    """
    found = _block_rows(lines)
    if found is None:
        return None
    delimiter, rows = found
    heads = rows[_NAMES][1]
    steps, given = (rows[key][1] if key in rows else [""] * len(heads) for key in (_STEP, _UNIT))
    width = min(len(heads), len(steps), len(given))
    last = max(k for key, (k, _) in rows.items() if key == _NAMES or key.startswith(_UNIT))
    first = next((k for k in range(last + 1, len(lines)) if _begins_with_number(lines[k], delimiter)), len(lines))
    values = lines[first].split(delimiter) if first < len(lines) else []
    times = [name == _NAMES for name in heads[:width]]
    main = Counter(step for step, is_time in zip(steps, times, strict=False) if not is_time).most_common(1)
    names: list[str] = []
    units: list[str | None] = []
    began, suffix = None, ""  # of the first group of the main sample time
    for k in range(width):
        if times[k]:
            step, start = steps[min(k + 1, width - 1)], _number(values[k] if k < len(values) else "")
            alike = bool(main) and step == main[0][0]
            again = alike and began is not None
            began = start if alike and began is None else began
            late = start - began if again and began is not None else 0.0
            suffix = "" if alike and late == 0.0 else f"@{late:+g}ms" if alike else f"@{step}ms"
            names.append(f"time{suffix or (f'@{k + 1}' if again else '')}")
        else:
            names.append(heads[k] + suffix)
        units.append("ms" if times[k] else _unit(given[k]))
    return Block(delimiter, tuple(names), tuple(units), first)


def _block_rows(lines: Sequence[str]) -> tuple[str, dict[str, tuple[int, list[str]]]] | None:
    """The delimiter, and each row of the block by its key with its line; None where there is no block."""
    plainest = None
    for delimiter in "\t;,":
        rows = {
            line.split(delimiter, 1)[0]: (k, [cell.strip() for cell in line.rstrip("\r\n").split(delimiter)])
            for k, line in enumerate(lines[:_LINES])
            if delimiter in line
        }
        if {_NAMES, _STEP} <= set(rows):  # units may be left out of an export
            return delimiter, rows
        if plainest is None and {_NAMES, _STARTED} <= set(rows):  # above the block there is a tab in any case
            plainest = delimiter, rows
    return plainest


def _unit(cell: str) -> str | None:
    """`V (Voltage)`, `(deg/s)`, `N m` or `(None)`."""
    text = cell.strip("()") if cell.startswith("(") else cell.split(" (")[0]
    return text.replace("None", "").strip() or None


def _begins_with_number(line: str, delimiter: str) -> bool:
    return math.isfinite(_number(line.split(delimiter, 1)[0], otherwise=math.nan))


def _number(cell: str, *, otherwise: float = 0.0) -> float:
    try:
        return float(cell.replace(",", "."))
    except ValueError:
        return otherwise
