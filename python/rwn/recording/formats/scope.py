"""The block of names, sample times and units above the numbers of a TwinCAT Scope export.

Each group of channels with one sample time begins with a column of times in ms, headed `Name`. Source: Beckhoff
Infosys, TE13xx Scope View, Export to csv.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import NamedTuple

_NAMES, _STEP, _UNIT = "Name", "SampleTime[ms]", "Unit"
_LINES = 60  # within which the block ends


class Block(NamedTuple):
    """`names` and `units` (None: not said) of the columns; `first`: lines above the first row of numbers."""

    delimiter: str
    names: tuple[str, ...]
    units: tuple[str | None, ...]
    first: int


def scope_block(lines: Sequence[str]) -> Block | None:
    """The block above the numbers; None where there is none.

    The times of the sample time with most channels are called `time`; channels of another one, whose rows are of other
    instants, are called `NAME@5ms`.
    """
    for delimiter in "\t;,":
        rows = {
            line.split(delimiter, 1)[0]: (k, [cell.strip() for cell in line.rstrip("\r\n").split(delimiter)])
            for k, line in enumerate(lines[:_LINES])
            if delimiter in line
        }
        if all(key in rows for key in (_NAMES, _STEP, _UNIT)):
            break
    else:
        return None
    heads, steps, given = (rows[key][1] for key in (_NAMES, _STEP, _UNIT))
    width = min(len(heads), len(steps), len(given))
    times = [name == _NAMES for name in heads[:width]]
    main = Counter(step for step, is_time in zip(steps, times, strict=False) if not is_time).most_common(1)
    names: list[str] = []
    units: list[str | None] = []
    for k in range(width):
        step = steps[k + 1] if times[k] and k + 1 < width else steps[k]
        suffix = "" if main and step == main[0][0] else f"@{step}ms"
        names.append(("time" if times[k] else heads[k]) + suffix)
        units.append("ms" if times[k] else given[k].split(" ")[0].strip("()").replace("None", "") or None)
    last = max(k for k, cells in rows.values() if cells[0].startswith(_UNIT))
    first = next((k for k in range(last + 1, len(lines)) if lines[k].strip()), len(lines))
    return Block(delimiter, tuple(names), tuple(units), first)
