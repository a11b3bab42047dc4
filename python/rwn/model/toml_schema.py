"""The tables and types of a model file, and msgspec's refusals in our words."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator
from typing import Any

import msgspec

from rwn.errors import InputError, closest, unrecognised
from rwn.model.toml_own_effects import OwnEffectEntry, ParameterEntry
from rwn.recording.intersample import AUTO
from rwn.recording.layout import Initial

MOST_WHOLE = 2**63 - 1  # what TOML promises to hold
Number = float | str  # a number in SI, or a string with a unit: "0.4 mH"


class ColumnEntry(msgspec.Struct, forbid_unknown_fields=True):
    """A table under `recording.columns`."""

    source: str | None = None  # the column of the signal's name
    unit: str | None = None
    scale: Number = 1.0


class RecordingTable(msgspec.Struct, forbid_unknown_fields=True):
    """The table `[recording]`."""

    columns: dict[str, ColumnEntry] = {}
    sample_time: Number | None = None
    initial: Initial = "auto"
    initial_samples: int = 20
    intersample: str = AUTO
    delays: dict[str, Number] = {}
    filters: dict[str, Number] = {}
    start: Number | None = msgspec.field(default=None, name="from")
    end: Number | None = msgspec.field(default=None, name="to")
    decimate: int = 1
    rename: dict[str, str] = {}
    profile: str | None = None
    speed_rows: tuple[int, int] | None = None


class LoadTable(msgspec.Struct, forbid_unknown_fields=True):
    """The table `[load]`."""

    pendulum: dict[str, Number] | None = None


class File(msgspec.Struct, forbid_unknown_fields=True):
    """A model file."""

    motor: dict[str, Any]
    uncertainty: dict[str, Number | dict[str, Number]] = {}  # of the motor, and of its effects by name
    effects: dict[str, dict[str, Number]] = {}
    own_effects: dict[str, OwnEffectEntry] = {}
    load: LoadTable = msgspec.field(default_factory=LoadTable)
    recording: RecordingTable = msgspec.field(default_factory=RecordingTable)


def decode(text: str, where: str) -> File:
    """The tables of a model file. Raises InputError where it is no TOML or has others."""
    try:
        plain = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise InputError(
            f"not valid TOML: {error}",
            where=where,
            expected="lines such as inertia = 1.8e-4",
            fix="correct that line; text needs quotes, numbers a decimal point"
            if "=" in text
            else "was a recording given as --model?",
        ) from error
    except (RecursionError, ValueError) as error:  # tables within tables, numbers of thousands of digits
        raise InputError(
            "the file nests too deep" if isinstance(error, RecursionError) else "a number has too many digits",
            where=where,
            expected="lines such as inertia = 1.8e-4",
            fix="write the model as docs/models.md shows",
        ) from error
    if "motor" not in plain:
        meant = closest("motor", plain)
        raise InputError(
            "there is no table [motor]",
            where=where,
            expected='[motor] with kind = "dc"',
            fix=f"did you mean [motor] by [{meant}]?" if meant else "add it",
        )
    try:
        return msgspec.convert(plain, File)
    except msgspec.ValidationError as error:
        for keys in _whole_numbers_beyond(plain, MOST_WHOLE) if "out of range" in str(error) else ():
            raise InputError(
                "the number is too large",
                where=f"{where}, [{'.'.join(keys[:-1])}] {keys[-1]}",
                expected=f"a whole number of at most {MOST_WHOLE}, or one with a decimal point",
                fix="correct the value",
            ) from error
        raise _worded(str(error), where) from error
    except (RecursionError, OverflowError) as error:
        raise InputError(
            "a value nests too deep, or is too large",
            where=where,
            expected="lines such as inertia = 1.8e-4",
            fix="write the model as docs/models.md shows",
        ) from error


def _whole_numbers_beyond(value: object, most: int, keys: tuple[str, ...] = ()) -> Iterator[tuple[str, ...]]:
    """The keys of whole numbers that are larger."""
    if isinstance(value, int) and abs(value) > most:
        yield keys
    held = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, inner in held:
        yield from _whole_numbers_beyond(inner, most, (*keys, str(key)))


_QUANTITY = "a number, or text with a unit"
_EXPECTED = {
    "float | str": _QUANTITY, "float | str | object": _QUANTITY, "str": "text in quotes", "object": "a table",
    "int": "a whole number", "float": "a number", "bool": "true or false", "array": "a list",
}  # fmt: skip
_GOT = {
    "int": "a number", "float": "a number", "bool": "true or false", "str": "text", "object": "a table",
    "array": "a list",
}  # fmt: skip


def _worded(message: str, where: str) -> InputError:
    """msgspec's `Expected `x`, got `y` - at `$.a.b`` in our words."""
    what, _, path = message.partition(" - at `$")
    keys = [key for key in re.split(r"[.\[\]`]+", path) if key and key != "..."]
    place = f"{where}, [{'.'.join(keys)}]" if keys else where
    found = re.search(r"unknown field `(.+)`", what)
    if found:
        return unrecognised("key", found[1], _table_at(keys).__struct_encode_fields__, where=place)
    wrong = re.search(r"[Ee]xpected `(.+?)`, got `(.+?)`", what)
    if wrong:
        return InputError(
            f"the value is {_GOT.get(wrong[2], wrong[2])}",
            where=place,
            expected=_EXPECTED.get(wrong[1].removesuffix(" | null"), wrong[1]),
            fix="correct the value",
        )
    missing = re.search(r"missing required field `(.+)`", what)
    if missing:
        return InputError(f"'{missing[1]}' is missing", where=place, expected=f"{missing[1]} = ..", fix="add it")
    return InputError(
        what.replace("`", "'"), where=place, expected="a value such as docs/models.md shows", fix="correct the value"
    )


def _table_at(keys: list[str]) -> type[msgspec.Struct]:
    """The table that a path of keys leads to."""
    nested: dict[tuple[str, str], type[msgspec.Struct]] = {
        ("recording", "columns"): ColumnEntry,
        ("own_effects", "parameters"): ParameterEntry,
    }
    for (outer, inner), entry in nested.items():
        if keys[:1] == [outer] and inner in keys:
            return entry
    tables: dict[str, type[msgspec.Struct]] = {
        "recording": RecordingTable,
        "load": LoadTable,
        "own_effects": OwnEffectEntry,
    }
    return tables.get(keys[0] if keys else "", File)
