"""ASAM MDF 4 (.mf4), read by asammdf: channels with their units, each at the instants of its group."""

from __future__ import annotations

import gc
import sys
import traceback
from collections.abc import Collection
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from rwn.errors import InputError
from rwn.recording.formats.channels import Channel, table_of_channels
from rwn.recording.formats.extra import library, quiet
from rwn.recording.formats.mdf_blocks import is_version_4, refuse_circles
from rwn.recording.formats.table import Table


def read_mdf(path: Path, wanted: Collection[str] = ()) -> Table:
    """The `wanted` channels by name, in physical values. Raises InputError where the file is no MDF.

    Of several channels of one name the first is read, which is noted.
    """
    asammdf = library("asammdf", "mdf", path)
    try:
        with quiet("asammdf"), path.open("rb") as stream:
            if not is_version_4(stream):
                raise _no_version_4(path)
            refuse_circles(stream)
            stream.seek(0)
            with asammdf.MDF(stream) as file:
                channels, units, several = _channels(file, wanted)
    except (OSError, InputError):
        raise
    except Exception as error:  # asammdf raises many kinds for what is no MDF
        _forget(error)
        raise InputError(
            "the file is not MDF, or it is damaged",
            where=path,
            expected="a complete MDF 4 file",
            fix="write it again, or export the recording as CSV",
        ) from error
    notes = tuple(f"{path}: {count} channels are called '{name}': the first is read" for name, count in several.items())
    return replace(table_of_channels(str(path), channels, units, wanted), notes=notes)


def _no_version_4(path: Path) -> InputError:
    return InputError(
        "the file is not MDF 4", where=path, expected="a complete MDF 4 file",
        fix="convert it, as asammdf does (asammdf.MDF(path).convert('4.10')), or export the recording as CSV",
    )  # fmt: skip


def _forget(error: BaseException | None) -> None:
    """Lets go of what asammdf left half open; its destructor would fail later, and Python print that."""
    hook, sys.unraisablehook = sys.unraisablehook, lambda _: None
    try:
        while error is not None:
            traceback.clear_frames(error.__traceback__)
            error = error.__context__
        gc.collect()
    finally:
        sys.unraisablehook = hook


def _channels(
    file: Any, wanted: Collection[str]
) -> tuple[dict[str, Channel], dict[str, str | None], dict[str, int]]:
    """The wanted ones, the unit of each, and how many bear the name of a wanted one, where several do."""
    masters = file.masters_db  # group -> place of its time
    channels: dict[str, Channel] = {}
    units: dict[str, str | None] = {}
    several: dict[str, int] = {}
    for name, places in file.channels_db.items():
        group, index = places[0]
        if masters.get(group) == index:
            continue
        units[name] = file.get_channel_unit(group=group, index=index) or None
        if name in wanted:
            _refuse_overlong(file.groups[group])
            if len(places) > 1:
                several[name] = len(places)
            signal = file.get(group=group, index=index)
            channels[name] = Channel(np.asarray(signal.timestamps, dtype=np.float64), signal.samples)
    return channels, units, several


def _refuse_overlong(group: Any) -> None:
    """Raises ValueError where a channel lies beyond the records of its group: asammdf would read what is no file."""
    room = 8 * group.channel_group.samples_byte_nr
    if any(8 * one.byte_offset + one.bit_offset + one.bit_count > room for one in group.channels):
        raise ValueError("a channel lies beyond its record")
