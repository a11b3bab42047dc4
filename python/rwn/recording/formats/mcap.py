"""MCAP files, ROS 2 bags among them, read by mcap and mcap-ros2-support: the numbers in the messages of each topic."""

from __future__ import annotations

import json
from collections import defaultdict
from collections.abc import Collection, Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from rwn.errors import InputError
from rwn.recording.formats.channels import Channel, table_of_channels
from rwn.recording.formats.extra import library
from rwn.recording.formats.table import MAX_SAMPLES, Table, too_long

_DEPTH, _MOST = 8, 64  # of fields in fields; numbers of a list: longer ones are images and clouds


def read_mcap(path: Path, wanted: Collection[str] = ()) -> Table:
    """The `wanted` numbers: `/topic.field`, `/topic.list[0]`; in a JointState `/joint_states.wheel.velocity`.

    ROS 2 (CDR) and JSON messages are read. An instant is the header's stamp where a message has one, else when it was
    logged. Units are not in such files. Raises InputError where the file is no MCAP.
    """
    reader = library("mcap.reader", "mcap", path)
    numbers: dict[str, list[float]] = defaultdict(list)
    unread: dict[str, str] = {}  # topic -> its encoding
    instants: dict[str, list[float]] = defaultdict(list)
    try:
        with path.open("rb") as file:
            factories = [_Json(), *_ros2(path), _Other()]
            messages = reader.make_reader(file, decoder_factories=factories).iter_decoded_messages()
            for _, channel, message, decoded in messages:
                if decoded is None:
                    unread[channel.topic] = channel.message_encoding
                at = _stamp(decoded, message.log_time)
                for name, value in _numbers(channel.topic, decoded, _DEPTH):
                    if name in wanted:
                        numbers[name].append(value)
                        instants[name].append(at)
                    else:
                        numbers.setdefault(name, [])
                if any(len(values) > MAX_SAMPLES for values in numbers.values()):
                    raise too_long(str(path), MAX_SAMPLES + 1)
    except InputError:
        raise
    except OSError:
        raise
    except Exception as error:  # mcap raises many kinds for what is no MCAP
        raise InputError(
            "the file is not MCAP, or it is damaged",
            where=path,
            expected="a complete MCAP file",
            fix="`mcap recover` it, or export the recording as CSV",
        ) from error
    _refuse_unread(unread, wanted, found=bool(numbers), where=path)
    channels = {name: _channel(instants[name], numbers[name]) for name in instants}
    return table_of_channels(str(path), channels, dict.fromkeys(numbers), wanted)


def _ros2(path: Path) -> Iterator[Any]:
    yield library("mcap_ros2.decoder", "mcap", path).DecoderFactory()


class _Json:
    """What mcap asks for a decoder of messages in JSON."""

    def decoder_for(self, message_encoding: str, _schema: Any) -> Any:
        return json.loads if message_encoding == "json" else None


def _refuse_unread(unread: Mapping[str, str], wanted: Collection[str], *, found: bool, where: Path) -> None:
    """Raises InputError where a topic in another encoding (`unread`) is asked for, or nothing else is `found`."""
    asked = [topic for topic in unread if not found or any(name.startswith(f"{topic}.") for name in wanted)]
    if asked:
        raise InputError(
            f"messages of {asked[0]} are in another encoding ({unread[asked[0]] or 'none is said'})",
            where=where,
            expected="ROS 2 (CDR, ros2msg) or JSON",
            fix="export the recording as CSV",
        )


class _Other:
    """A decoder of what is in any other encoding: nothing. A topic of it beside those that are wanted does no harm."""

    def decoder_for(self, _message_encoding: str, _schema: Any) -> Any:
        return lambda _message: None


def _stamp(decoded: Any, logged: int) -> float:
    """The instant of a message [s]."""
    header = _fields(decoded).get("header")
    stamp = _fields(header).get("stamp") if header is not None else None
    told = _fields(stamp) if stamp is not None else {}
    seconds, nanoseconds = told.get("sec"), told.get("nanosec", told.get("nsec"))
    if isinstance(seconds, int) and isinstance(nanoseconds, int) and (seconds or nanoseconds):
        return seconds + 1e-9 * nanoseconds
    return 1e-9 * logged


def _fields(of: Any) -> dict[str, Any]:
    if isinstance(of, dict):
        return of
    return {name: getattr(of, name) for name in getattr(of, "__slots__", ()) if hasattr(of, name)}


def _numbers(name: str, value: Any, depth: int) -> Iterator[tuple[str, float]]:
    """The numbers within a message by their names; lists beside a list `name` of the same length go by it."""
    if isinstance(value, bool | int | float):
        yield name, float(value)
    elif isinstance(value, str | bytes) or depth == 0:
        return
    elif isinstance(value, list | tuple) or hasattr(value, "dtype"):
        if len(value) <= _MOST:
            for k, element in enumerate(value):
                yield from _numbers(f"{name}[{k}]", _native(element), depth - 1)
    else:
        fields = _fields(value)
        called = fields.get("name")
        for field, inner in fields.items():
            if _go_together(called, inner):
                for each, element in zip(called or (), inner, strict=True):
                    yield from _numbers(f"{name}.{each}.{field}", _native(element), depth - 1)
            elif field != "name":
                yield from _numbers(f"{name}.{field}", _native(inner), depth - 1)


def _go_together(called: Any, values: Any) -> bool:
    if not isinstance(called, list) or isinstance(values, str | bytes) or values is called:
        return False
    return hasattr(values, "__len__") and len(values) == len(called) > 0


def _native(value: Any) -> Any:
    return value.item() if isinstance(value, np.generic) else value


def _channel(instants: list[float], values: list[float]) -> Channel:
    at = np.array(instants)
    order = np.argsort(at, kind="stable")
    return Channel(at[order], np.array(values)[order])
