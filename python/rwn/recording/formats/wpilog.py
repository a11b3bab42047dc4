"""WPILib data logs (.wpilog), version 1.0: timestamped entries, each started with its name, type and metadata.

Source of the format: allwpilib, wpiutil/doc/datalog.adoc.
"""

from __future__ import annotations

import json
import re
import struct
from collections.abc import Collection, Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from rwn.errors import InputError
from rwn.recording import units
from rwn.recording.formats.channels import Channel, table_of_channels
from rwn.recording.formats.table import Table

_MAGIC = b"WPILOG"
_HEADER = struct.Struct("<6sHI")  # magic, version, length of a text that follows
_TYPES = {"boolean": "?", "int64": "<i8", "float": "<f4", "double": "<f8"}  # of a number, as numpy names them
_WORD = re.compile("[A-Za-z]{3}")
_CONTROL, _START, _METADATA = 0, 0, 2


@dataclass
class _Entry:
    name: str
    kind: str
    metadata: str
    instants: list[int] = field(default_factory=list)  # us
    payloads: list[bytes] = field(default_factory=list)


def read_wpilog(path: Path, wanted: Collection[str] = ()) -> Table:
    """The `wanted` entries of one number, by their names; a unit is an entry's metadata where that is one.

    Of an entry of several numbers `name[0]` is the first. Raises InputError where the file is no such log; a log that
    was cut off is read up to there, which is noted.
    """
    data = path.read_bytes()
    if len(data) < _HEADER.size or not data.startswith(_MAGIC) or _HEADER.unpack_from(data)[1] >> 8 != 1:
        raise InputError(
            "this is no WPILib data log of version 1",
            where=path,
            expected="a .wpilog file",
            fix="copy it from the robot again, or export the recording as CSV",
        )
    entries: dict[str, _Entry] = {}
    open_now: dict[int, _Entry] = {}
    start = end = _HEADER.size + _HEADER.unpack_from(data)[2]
    for number, instant, payload, after in _records(data, start):
        end = after
        if number == _CONTROL:
            _control(payload, entries, open_now)
        elif number in open_now:
            open_now[number].instants.append(instant)
            open_now[number].payloads.append(payload)
    channels: dict[str, Channel] = {}
    told: dict[str, str | None] = {}
    for entry in entries.values():
        for name, column in _names(entry):
            told[name] = _unit(entry.metadata)
            if name in wanted:
                channels[name] = _channel(entry, column)
    table = table_of_channels(str(path), channels, told, wanted)
    lost = f"{path}: read up to byte {end} of {len(data)}: what follows is no whole record"
    return replace(table, notes=(lost,)) if end < len(data) else table


def _records(data: bytes, at: int) -> Iterator[tuple[int, int, bytes, int]]:
    """Entry, time [us], payload and end of each record; a record that is not whole ends them."""
    while at < len(data):
        bits = data[at]
        sizes = ((bits & 3) + 1, (bits >> 2 & 3) + 1, (bits >> 4 & 7) + 1)
        at += 1
        numbers = []
        for size in sizes:
            numbers.append(int.from_bytes(data[at : at + size], "little"))
            at += size
        entry, length, instant = numbers
        if at + length > len(data):
            return
        at += length
        yield entry, instant, data[at - length : at], at


def _control(payload: bytes, entries: dict[str, _Entry], open_now: dict[int, _Entry]) -> None:
    """Starts an entry, or gives it other metadata; what is no such record is passed over."""
    if len(payload) < 5:
        return
    number, texts = int.from_bytes(payload[1:5], "little"), _texts(payload, 5)
    if payload[0] == _START and len(texts) == 3:
        name, kind, metadata = texts
        open_now[number] = entries.setdefault(name, _Entry(name, kind, metadata))
    elif payload[0] == _METADATA and texts and number in open_now:
        open_now[number].metadata = texts[0]


def _texts(payload: bytes, at: int) -> list[str]:
    """Texts that are each preceded by their length."""
    texts = []
    while at + 4 <= len(payload):
        end = at + 4 + int.from_bytes(payload[at : at + 4], "little")
        texts.append(payload[at + 4 : end].decode("utf-8", "replace"))
        at = end
    return texts


def _names(entry: _Entry) -> Iterator[tuple[str, int]]:
    """The names under which an entry's numbers are read, each with its place."""
    if entry.kind in _TYPES:
        yield entry.name, 0
    elif entry.kind.removesuffix("[]") in _TYPES and entry.payloads:
        size = np.dtype(_TYPES[entry.kind.removesuffix("[]")]).itemsize
        for k in range(min(len(payload) for payload in entry.payloads) // size):
            yield f"{entry.name}[{k}]", k


def _channel(entry: _Entry, column: int) -> Channel:
    kind = np.dtype(_TYPES[entry.kind.removesuffix("[]")])
    first, last = column * kind.itemsize, (column + 1) * kind.itemsize
    whole = [k for k, payload in enumerate(entry.payloads) if len(payload) >= last]
    values = np.frombuffer(b"".join(entry.payloads[k][first:last] for k in whole), dtype=kind)
    instants = np.array([entry.instants[k] for k in whole], dtype=np.float64) * 1e-6
    order = np.argsort(instants, kind="stable")  # the format does not promise an order
    return Channel(instants[order], values[order].astype(np.float64))


def _unit(metadata: str) -> str | None:
    """A unit that was written as metadata ("Meter per Second", {"unit": "rad/s"}); other notes are none.

    SysIdRoutineLog writes its name alone, AdvantageKit and NetworkTables an object of JSON.
    """
    text = _noted(metadata).replace("_", " ")
    if _WORD.search(text):  # of a symbol, as A, the case says which unit it is
        text = text.lower()
    return text if text and len(text) < 60 and units.is_unit(text) else None


def _noted(metadata: str) -> str:
    if not metadata.lstrip().startswith("{"):
        return metadata
    try:
        noted = json.loads(metadata)
    except (ValueError, RecursionError):  # a note that only looks like JSON
        return ""
    texts = (noted.get(key) for key in ("unit", "units"))
    return next((text for text in texts if isinstance(text, str)), "")
