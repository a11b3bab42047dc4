"""LabVIEW's TDMS, read by npTDMS: channels in groups, with the properties that LabVIEW gives a waveform."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from rwn.errors import InputError
from rwn.recording.formats.channels import Array, Channel, table_of_channels
from rwn.recording.formats.extra import library, quiet
from rwn.recording.formats.frame import name_and_unit_of
from rwn.recording.formats.part import Within
from rwn.recording.formats.table import MAX_SAMPLES, Table, refuse_doubles, table_of, too_long

_UNIT, _STEP, _BEGAN = "unit_string", "wf_increment", "wf_start_time"


def read_tdms(path: Path, wanted: Collection[str] = ()) -> Table:
    """The `wanted` channels, named `Group.Channel`, or `Channel` alone in a file with one group.

    Units from the property `unit_string` or the name, `speed [rpm]`; times of waveforms from `wf_increment` and
    `wf_start_time`. Raises InputError where the file is no TDMS.
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
    alone = len(groups) == 1 and not isinstance(wanted, Within)  # a group that is asked for has its name
    found: list[tuple[str, Any, str | None]] = []
    for group in groups:
        for channel in group.channels():
            name, unit = name_and_unit_of(channel.name)
            unit = channel.properties.get(_UNIT) or unit
            found.append((name if alone else f"{group.name}.{name}", channel, unit))
    refuse_doubles(where, [name for name, _, _ in found], wanted)
    told = {name: (channel, unit) for name, channel, unit in found}
    used = {name: channel for name, (channel, _) in told.items() if name in wanted}
    for channel in used.values():
        if len(channel) > MAX_SAMPLES:
            raise too_long(where, len(channel))
    units = {name: unit for name, (_, unit) in told.items()}
    if used and all(map(_step, used.values())):
        began = _began(list(used.values()))
        channels = {
            name: Channel(np.round(at + _instants(channel), 9), channel[:])  # else equal instants differ by rounding
            for (name, channel), at in zip(used.items(), began, strict=True)
        }
        return table_of_channels(where, channels, units, wanted)
    arrays = {name: used[name][:] if name in used else None for name in told}
    return table_of(where, arrays, units, wanted)


def _step(channel: Any) -> float:
    """The time from sample to sample [s]; 0 where the file states none that is one."""
    step = channel.properties.get(_STEP, 0.0)
    return float(step) if isinstance(step, float | int | np.floating) and step > 0.0 else 0.0


def _began(channels: Sequence[Any]) -> list[float]:
    """When each waveform began [s], after the first of them; at once where the file does not say it of all."""
    stamps = [channel.properties.get(_BEGAN) for channel in channels]
    told = [stamp for stamp in stamps if isinstance(stamp, np.datetime64)]
    return [float((s - min(told)) / np.timedelta64(1, "s")) for s in told] if told == stamps else [0.0] * len(stamps)


def _instants(channel: Any) -> Array:
    start = float(channel.properties.get("wf_start_offset", 0.0))
    return start + _step(channel) * np.arange(len(channel), dtype=np.float64)
