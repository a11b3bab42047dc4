"""Effects that a user defines in the model file or in Python; see docs/own_effects.md."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import msgspec

from rwn import expression
from rwn.drives import DC, Drive
from rwn.errors import InputError, unknown
from rwn.expression import Expression

# term: (site, SI unit on a shaft, on a linear axis, what the formula is); signs as in the motor equations.
TERMS: dict[str, tuple[str, str, str, str]] = {
    "torque": ("torque", "N m", "N", "torque that drives positive rotation"),
    "friction": ("torque", "N m", "N", "level of a dry friction that opposes motion and holds at standstill"),
    "load": ("load", "N m", "N", "torque of the load that drives positive rotation"),
    "drop": ("voltage", "V", "V", "voltage lost in the winding circuit"),
    "resistance": ("voltage", "1", "1", "factor of the resistance"),
    "flux": ("flux", "1", "1", "factor of both motor constants"),
    "inductance": ("flux", "1", "1", "factor of the inductance"),
    "input": ("actuator", "", "", "what acts in place of the commanded input"),
    "current": ("sensor", "A", "A", "current as it is recorded"),
    "speed": ("sensor", "rad/s", "m/s", "speed as it is recorded"),
    "position": ("sensor", "rad", "m", "position as it is recorded"),
}

# What a formula may use beside parameters: name -> (unit on a shaft, on a linear axis).
VARIABLES: dict[str, tuple[str, str]] = {
    "time": ("s", "s"),
    "input": ("", ""),  # that of the drive's input
    "current": ("A", "A"),
    "speed": ("rad/s", "m/s"),
    "position": ("rad", "m"),
    "direction": ("1", "1"),
    "drive_torque": ("N m", "N"),
}


@dataclass(frozen=True, kw_only=True)
class OwnParameter:
    """A parameter in SI, fitted from `start` within bounds. `strength`: at zero the effect is absent."""

    name: str
    unit: str
    lower: float
    upper: float
    start: float
    meaning: str = ""
    strength: bool = False

    @property
    def fixed(self) -> bool:
        """Never: a constant belongs into the formula."""
        return False


@dataclass(frozen=True, kw_only=True)
class OwnEffect:
    """A user's effect: `equation` is the `term` of the motor's equations that it changes (a key of TERMS).

    Raises InputError when a name, bound, formula or unit is wrong.
    """

    name: str
    term: str
    equation: str
    parameters: tuple[OwnParameter, ...]
    drive: Drive = DC
    meaning: str = ""
    source: str = ""

    def __post_init__(self) -> None:
        where = f"own effect '{self.name}'"
        if not re.fullmatch(r"[a-z][a-z0-9]*(-[a-z0-9]+)*", self.name):
            raise InputError(
                "the name is not usable", where=where, expected="small letters and hyphens", fix="rename it"
            )
        if self.term not in TERMS:
            raise unknown("term", self.term, TERMS, where=where)
        for parameter in self.parameters:
            _check_parameter(parameter, where)
        if not any(p.strength for p in self.parameters):
            raise InputError(
                "no parameter is its strength",
                where=where,
                expected="one with strength = true, at whose zero the effect is absent",
                fix="mark the amplitude",
            )
        expression.check_units(self.formula, self._names, self._unit, where=f"{where}, equation")

    @property
    def site(self) -> str:
        """Where it attaches, as for the effects that come with rwn."""
        return TERMS[self.term][0]

    @cached_property
    def formula(self) -> Expression:
        """The equation, compiled."""
        return expression.parse(self.equation, self._names, where=f"own effect '{self.name}', equation")

    @property
    def _names(self) -> dict[str, str]:
        """Every name that the equation may use, with its SI unit; a parameter's own name comes first."""
        linear = self.drive.input == "force"
        known = {name: unit[linear] or _input_unit(self.drive) for name, unit in VARIABLES.items()}
        nominal = {p.name: (p.linear_unit if linear else "") or p.unit for p in self.drive.parameters}
        return known | nominal | {p.name: p.unit for p in self.parameters}

    @property
    def _unit(self) -> str:
        return TERMS[self.term][1 + (self.drive.input == "force")] or _input_unit(self.drive)


def _input_unit(drive: Drive) -> str:
    return {"voltage": "V", "torque": "N m", "force": "N"}[drive.input]


def _check_parameter(p: OwnParameter, where: str) -> None:
    if not p.name.isidentifier() or p.name in VARIABLES or p.name in expression.FUNCTIONS:
        raise InputError(
            f"a parameter cannot be called '{p.name}'",
            where=where,
            expected="a name of its own",
            fix="rename it",
        )
    if (
        not all(map(math.isfinite, (p.lower, p.start, p.upper)))
        or not p.lower <= p.start <= p.upper
        or p.lower == p.upper
    ):
        raise InputError(
            f"{p.name} starts at {p.start:g} between {p.lower:g} and {p.upper:g}",
            where=where,
            expected="finite lower <= start <= upper",
            fix="correct the bounds",
        )


class ParameterEntry(msgspec.Struct, forbid_unknown_fields=True):
    unit: str
    lower: float
    upper: float
    start: float
    meaning: str = ""
    strength: bool = False


class EffectEntry(msgspec.Struct, forbid_unknown_fields=True):
    """A table [own_effects.<name>] of a model file."""

    term: str
    equation: str
    parameters: dict[str, ParameterEntry]
    meaning: str = ""
    source: str = ""


def from_entry(name: str, entry: EffectEntry, drive: Drive, *, where: str) -> OwnEffect:
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
        given = {key: value for key, value in vars(p).items() if key != "name" and value not in ("", False)}
        given |= {key: float(getattr(p, key)) for key in ("lower", "upper", "start")}
        values = ", ".join(f"{key} = {text(value)}" for key, value in given.items())
        lines.append(f"parameters.{p.name} = {{ {values} }}")
    return lines


def _texts(effect: OwnEffect) -> list[str]:
    return [key for key in ("term", "equation", "meaning", "source") if getattr(effect, key)]
