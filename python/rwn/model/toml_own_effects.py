"""Own effects as tables [own_effects.<name>] of a model file; see docs/own_effects.md."""

from __future__ import annotations

from typing import Any

import msgspec

from rwn.errors import InputError
from rwn.model.drives.drive import Drive
from rwn.model.own_effects import OwnEffect, OwnParameter


class ParameterEntry(msgspec.Struct, forbid_unknown_fields=True):
    """A table under `effects.NAME.parameters`."""

    unit: str
    lower: float
    upper: float
    start: float
    meaning: str = ""
    strength: bool = False
    phase: bool = False


class OwnEffectEntry(msgspec.Struct, forbid_unknown_fields=True):
    """A table [own_effects.<name>] of a model file."""

    term: str
    equation: str
    parameters: dict[str, ParameterEntry]
    meaning: str = ""
    source: str = ""


def from_entry(name: str, entry: OwnEffectEntry, drive: Drive, *, where: str) -> OwnEffect:
    """The effect that a table of the model file `where` defines. Raises InputError."""
    parameters = tuple(
        OwnParameter(name=key, **msgspec.structs.asdict(p)) for key, p in entry.parameters.items()
    )
    rest: dict[str, Any] = msgspec.structs.asdict(entry) | {"parameters": parameters}
    try:
        return OwnEffect(name=name, drive=drive, **rest)
    except InputError as error:
        place = f"{where}, {error.where}"
        raise InputError(error.what, where=place, expected=error.expected, fix=error.fix) from error


def to_lines(effect: OwnEffect) -> list[str]:
    """The table of a model file that defines `effect`."""

    def text(value: object) -> str:
        return msgspec.json.encode(value).decode()

    lines = [
        "",
        f"[own_effects.{effect.name}]",
        *(f"{k} = {text(getattr(effect, k))}" for k in _texts(effect)),
    ]
    for p in effect.parameters:
        given: dict[str, object] = {"unit": p.unit}
        given |= {key: float(getattr(p, key)) for key in ("lower", "upper", "start")}
        given |= {key: getattr(p, key) for key in ("strength", "phase", "meaning") if getattr(p, key)}
        values = ", ".join(f"{key} = {text(value)}" for key, value in given.items())
        lines.append(f"parameters.{p.name} = {{ {values} }}")
    return lines


def _texts(effect: OwnEffect) -> list[str]:
    return [key for key in ("term", "equation", "meaning", "source") if getattr(effect, key)]
