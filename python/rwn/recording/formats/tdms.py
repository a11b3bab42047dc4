"""LabVIEW's TDMS, read by npTDMS: channels in groups, with the properties that LabVIEW gives a waveform."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path
from typing import Any

import numpy as np

from rwn.errors import InputError
from rwn.recording.formats.channels import Array, Channel, table_of_channels
from rwn.recording.formats.extra import library, quiet
from rwn.recording.formats.frame import name_and_unit_of
from rwn.recording.formats.table import MAX_SAMPLES, Table, refuse_doubles, table_of, too_long

_UNIT, _STEP = "unit_string", "wf_increment"


def read_tdms(path: Path, wanted: Collection[str] = ()) -> Table:
    """The `wanted` channels, named `Group.Channel`, or `Channel` alone in a file with one group.

    Units from the property `unit_string` or the name, `speed [rpm]`; times of waveforms from `wf_increment`. Raises
    InputError where the file is no TDMS.
    """
    nptdms = library("nptdms", "tdms", path)
    try:
        with quiet("nptdms"), path.open("rb") as stream, nptdms.TdmsFile.open(stream) as file:
            return _table(str(path), file, wanted)
    except InputError:
        raise
    except OSError:
        raise
    except Exception as error:  # npTDMS raises many kinds for what is no TDMS
        raise InputError(
            "the file is not TDMS, or it is damaged",
            where=path,
            expected="a complete TDMS file",
            fix="save it again, or export the recording as CSV",
        ) from error


def _table(where: str, file: Any, wanted: Collection[str]) -> Table:
    groups = file.groups()
    found: list[tuple[str, Any, str | None]] = []
    for group in groups:
        for channel in group.channels():
            name, unit = name_and_unit_of(channel.name)
            unit = channel.properties.get(_UNIT) or unit
            found.append((name if len(groups) == 1 else f"{group.name}.{name}", channel, unit))
    refuse_doubles(where, [name for name, _, _ in found], wanted)
    told = {name: (channel, unit) for name, channel, unit in found}
    used = {name: channel for name, (channel, _) in told.items() if name in wanted}
    for channel in used.values():
        if len(channel) > MAX_SAMPLES:
            raise too_long(where, len(channel))
    units = {name: unit for name, (_, unit) in told.items()}
    if used and all(_STEP in channel.properties for channel in used.values()):
        channels = {name: Channel(_instants(channel), channel[:]) for name, channel in used.items()}
        return table_of_channels(where, channels, units, wanted)
    arrays = {name: used[name][:] if name in used else None for name in told}
    return table_of(where, arrays, units, wanted)


def _instants(channel: Any) -> Array:
    start = float(channel.properties.get("wf_start_offset", 0.0))
    return start + float(channel.properties[_STEP]) * np.arange(len(channel), dtype=np.float64)
