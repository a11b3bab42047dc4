"""Channels that were logged each at its own instants, as rows of one table."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rwn.recording.formats.table import Table, table_of, vector
from rwn.recording.signals import TIME

Array = NDArray[np.float64]


class Channel(NamedTuple):
    """Values (n,) at `instants` (n,) [s], not decreasing; `unit` None: not said."""

    instants: Array
    values: Array
    unit: str | None = None


def table_of_channels(
    where: str, channels: Mapping[str, Channel], units: Mapping[str, str | None], wanted: Collection[str]
) -> Table:
    """The `wanted` ones of channels as rows with a column `time` in s; `units` names every channel there is.

    Channels with the same instants stay as they are. Others are put on the rows of the one that was logged most often,
    each with the value that it had then: that is exact for a command, which holds until the next, and what is measured
    more slowly shows as held samples. Rows before every channel has a value, and rows that repeat an instant, are left
    out. Raises InputError where a channel holds no real numbers, or too many.
    """
    used = {name: channel for name, channel in channels.items() if name in wanted and name != TIME.name}
    if not used:  # nor is there a time
        return Table(where=where, columns={}, units={n: unit for n, unit in units.items() if n != TIME.name})
    units = {**units, TIME.name: TIME.unit}
    told = {name: vector(where, name, channel.values) for name, channel in used.items()}
    longest = max(used, key=lambda name: len(told[name]))
    rows = used[longest].instants
    begins = max((channel.instants[0] if channel.instants.size else np.inf) for channel in used.values())
    kept = (rows >= begins) & (np.diff(rows, append=np.inf) > 0.0)
    rows = rows[kept]
    columns: dict[str, Array] = {TIME.name: rows}
    for name, channel in used.items():
        at = np.searchsorted(channel.instants, rows, side="right") - 1
        columns[name] = told[name][at]
    return table_of(where, {**dict.fromkeys(units), **columns}, units, columns)
