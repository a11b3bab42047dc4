"""What the files say that a diagnosis of a trial left, as far as it is graded; anything else is refused by field."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, Literal, TypeVar

import msgspec
from msgspec import Meta, Struct

from rwn.decide.verdict import Verdict
from rwn.errors import InputError
from rwn.faults.fault import RECORDING
from rwn.studies.trials.damaged import reading, refused

TIMING = "timing.json"
Probability = Annotated[float, Meta(ge=0.0, le=1.0)]
Kind = TypeVar("Kind")


class SaidParameter(Struct, omit_defaults=True):
    value: float
    unit: str
    interval: tuple[float, float] | None = None


class SaidEffect(Struct, omit_defaults=True):
    name: str
    equation: str
    probability: Probability | None = None
    parameters: dict[str, SaidParameter] = {}


class SaidBeneath(Struct):
    verdict: Verdict
    set: list[str]


class SaidActing(Struct):
    name: str
    probability: Probability


class SaidHeldout(Struct):
    recording: str
    signal: str
    nominal: float
    refitted: float
    corrected: float | None


class Said(Struct, omit_defaults=True):
    """Of diagnosis.json, which holds more."""

    verdict: Verdict
    equation: str = ""
    effects: list[SaidEffect] = []
    set: list[str] = []
    beneath: SaidBeneath | None = None
    adequate_probability: Probability | None = None
    account: list[SaidActing] = []
    heldout: list[SaidHeldout] = []
    format: Literal[1] = 1  # as the diagnoses of this version are written


class Timing(Struct, omit_defaults=True):
    """Of timing.json, which older codes wrote without all of these."""

    seconds: Annotated[float, Meta(ge=0.0)] | None = None
    date: str = ""
    commit: str = ""
    machine: str = ""


def said_in(path: Path) -> dict[str, Any]:
    """What a diagnosis.json says, of `Said`. Raises InputError with file and field."""
    said = _read(path, Said)
    if said.effects and said.verdict not in ("missing-physics", "recording-mistake"):
        raise refused(path, f"effects: there are some, and the verdict is {said.verdict}")
    for k, effect in enumerate(said.effects):
        for name, parameter in effect.parameters.items():
            if parameter.interval is not None and not parameter.interval[0] <= parameter.interval[1]:
                raise refused(path, f"effects[{k}].parameters.{name}.interval: it ends before it begins")
    if said.beneath is None and any(effect.equation == RECORDING for effect in said.effects):
        raise refused(path, "beneath: missing, and an effect is a mistake in the recordings")
    plain: dict[str, Any] = msgspec.to_builtins(said)
    return plain


def timing_of(place: Path) -> Timing:
    """What timing.json beside a diagnosis says; nothing where there is none. Raises InputError with file and field."""
    path = place / TIMING
    return _read(path, Timing) if path.exists() else Timing()


def _read(path: Path, kind: type[Kind]) -> Kind:
    with reading(path):
        plain = msgspec.json.decode(path.read_bytes())
        try:
            return msgspec.convert(plain, kind, strict=False)  # strict: no number may be a word, as inf is
        except msgspec.ValidationError as error:
            raise _by_field(path, str(error)) from error


def _by_field(path: Path, message: str) -> InputError:
    """msgspec's "Expected `x`, got `y` - at `$.a.b`", the field first."""
    what, _, at = message.replace("`", "'").partition(" - at '$")
    field = at.strip(".'")
    return refused(path, f"{field}: {what[0].lower()}{what[1:]}" if field else what[0].lower() + what[1:])
