"""What a diagnosis found, as plain data: drawn by the report, kept in diagnosis.json and its curves in curves.json."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from inspect import cleandoc
from typing import Any, Literal, Self

import msgspec
import numpy as np

from rwn.decide.account import ActingEffect, Remainder
from rwn.decide.verdict import Verdict
from rwn.mismatch_map.regions import Region
from rwn.name.found_effect import FoundEffect
from rwn.name.not_tried import NotTried
from rwn.prove.heldout import HeldoutRow
from rwn.recording.inspection import Finding
from rwn.report.fitted_filter import FittedFilter
from rwn.report.nominal_fit import NominalFit
from rwn.report.plot import Plot

FORMAT = 1  # of diagnosis.json and curves.json; a reader of another number cannot rely on what it knows
NUMBER = {
    "description": "a number, or where it is not finite, which JSON does not have, the word for it",
    "type": ["number", "string"],
    "pattern": "^(inf|-inf|nan)$",
}
NOT_WRITTEN = ("command", "corrected", "curves", "elapsed")  # fields that diagnosis.json leaves to other files


@dataclass(frozen=True, kw_only=True)
class Alternative:
    """An explanation of the recordings, with its probability among all that were tried."""

    effects: tuple[str, ...]
    probability: float
    separated_by: str = ""  # the experiment that would tell it from the stated one


@dataclass(frozen=True, kw_only=True)
class Location:
    """The equation that carries unknown input, and the regions where the mismatch's energy sits."""

    equation: str = ""
    regions: tuple[Region, ...] = ()
    description: str = ""  # "a torque that depends on angle, 14 periods per revolution, 3 mN m"
    briefly: str = ""  # "a torque that is strongest at low speed"


@dataclass(frozen=True, kw_only=True)
class Source:
    """A file that was used, and what for."""

    path: str
    use: Literal["model", "fit", "heldout"]
    samples: int = 0
    duration: float = 0.0  # [s]
    sha256: str = ""


@dataclass(frozen=True, kw_only=True)
class Beneath:
    """What is said of the drive once the mistakes in its recordings are undone."""

    verdict: Verdict
    set: tuple[str, ...] = ()


@dataclass(frozen=True, kw_only=True)
class DiagnosisData:
    """The verdict, what it rests on, and the curves that show it."""

    verdict: Verdict
    equation: str = ""
    effects: tuple[FoundEffect, ...] = ()
    set: tuple[str, ...] = ()  # names that these recordings cannot tell apart, the first is the first name
    beneath: Beneath | None = None  # where the verdict is recording-mistake
    explanation: Alternative | None = None  # that is stated, as the alternatives are; None where none is
    alternatives: tuple[Alternative, ...] = ()
    sensor_filters: tuple[FittedFilter, ...] = ()  # found in the noise, fitted as part of the measurement
    findings: tuple[Finding, ...] = ()  # what the check of the recordings found
    location: Location = field(default_factory=Location)
    nominal_fit: NominalFit = field(default_factory=NominalFit)
    heldout: tuple[HeldoutRow, ...] = ()
    curves: tuple[Plot, ...] = ()
    warnings: tuple[str, ...] = ()
    next_experiment: str = ""
    adequate_probability: float | None = None  # that nothing is missing
    account: tuple[ActingEffect, ...] = ()  # the effects of the leading explanation, stated or not
    remainder: Remainder = field(default_factory=Remainder)  # what the stated effects leave
    not_tried: tuple[NotTried, ...] = ()  # for what a search may cost
    sources: tuple[Source, ...] = ()
    command: str = field(default="", compare=False)
    seed: int = 0
    version: str = ""
    elapsed: float = field(default=0.0, compare=False)  # [s]; like command, left out of the JSON
    stand_in: str = ""  # what stands in corrected.toml for what has no name: "a wavelet network, a torque over speed"
    added: tuple[str, ...] = ()  # effects that corrected.toml holds beyond those of the model as given
    corrected: Any = None  # the corrected rwn.Model; written to corrected.toml, left out of the JSON

    def to_json(self) -> bytes:
        """`diagnosis.json`: what depends on input and seed alone, without the curves.

        A number that is not finite is a word (`NUMBER`).
        """
        kept = {name: value for name, value in vars(self).items() if name not in NOT_WRITTEN}
        return _text({"format": FORMAT, **kept})

    def curves_json(self) -> bytes:
        """`curves.json`: the pictures, each with its units, to six digits. NaN becomes null."""
        plots = _in_words(msgspec.to_builtins(self.curves, enc_hook=_plain))
        lines = b",\n".join(msgspec.json.encode(plot) for plot in plots)
        return b'{"format": %d, "curves": [\n%b\n]}\n' % (FORMAT, lines)

    @classmethod
    def from_json(cls, text: bytes | str, curves: bytes | str | None = None) -> Self:
        """The inverse of `to_json` and `curves_json`; without these a diagnosis has none.

        Raises ValueError (`msgspec.ValidationError` with the path of what is wrong).
        """
        plain = msgspec.json.decode(text)
        if isinstance(plain, dict):
            if plain.get("format", FORMAT) != FORMAT:
                raise ValueError(f"format {plain['format']}, this version reads {FORMAT}")
            drawn = msgspec.json.decode(curves) if curves is not None else {"curves": []}
            plain = {name: value for name, value in plain.items() if name not in NOT_WRITTEN}
            if isinstance(drawn, dict) and "curves" not in drawn:
                raise ValueError("no 'curves' in curves.json")
            plain["curves"] = drawn["curves"] if isinstance(drawn, dict) else drawn
        return msgspec.convert(plain, cls, dec_hook=_array, strict=False)  # strict: no number may be a word

    @classmethod
    def schema(cls) -> dict[str, Any]:
        """JSON Schema (2020-12) of diagnosis.json."""
        components: Mapping[str, Any]
        (whole,), components = msgspec.json.schema_components((DiagnosisData,), schema_hook=_numbers)
        parts = dict(_alike(components))
        top = dict(parts.pop(whole["$ref"].rsplit("/", 1)[-1]))
        kept = {name: rule for name, rule in top["properties"].items() if name not in NOT_WRITTEN}
        for name in ("Plot", "Trace", "Mark"):
            parts.pop(name)
        return {
            "$schema": "https://json-schema.org/draft/2020-12/schema", **top, "title": "diagnosis.json",
            "properties": {"format": {"const": FORMAT}, **_with_words(kept)}, "required": ["format", *top["required"]],
            "$defs": {**_with_words(parts), "Number": NUMBER},
        }  # fmt: skip


def _text(plain: Mapping[str, Any]) -> bytes:
    encoded = msgspec.json.encode(_in_words(msgspec.to_builtins(plain, enc_hook=_plain)))
    return msgspec.json.format(encoded, indent=1) + b"\n"


def _in_words(plain: Any) -> Any:
    """The same with a word in the place of each number that JSON does not have: null is what is not known."""
    if isinstance(plain, dict):
        return {name: _in_words(value) for name, value in plain.items()}
    if isinstance(plain, list | tuple):
        return [_in_words(value) for value in plain]
    return repr(plain) if isinstance(plain, float) and not np.isfinite(plain) else plain


def _alike(schema: Any) -> Any:
    """A schema without what versions of msgspec write differently: indents of texts, and that a mapping is empty."""
    if isinstance(schema, list | tuple):
        return [_alike(part) for part in schema]
    if not isinstance(schema, dict):
        return schema
    kept = {name: part for name, part in schema.items() if not (name == "default" and part == {})}
    return {
        name: cleandoc(part) if name == "description" and isinstance(part, str) else _alike(part)
        for name, part in kept.items()
    }


def _with_words(schema: Any) -> Any:
    """A schema in which each number is a NUMBER."""
    if isinstance(schema, list):
        return [_with_words(part) for part in schema]
    if not isinstance(schema, dict):
        return schema
    if schema.get("type") == "number":
        return {"$ref": "#/$defs/Number", **{name: rule for name, rule in schema.items() if name != "type"}}
    return {name: _with_words(part) for name, part in schema.items()}


def _plain(value: Any) -> Any:
    if isinstance(value, np.ndarray):
        return [float(f"{x:.6g}") if np.isfinite(x) else None for x in value]
    if isinstance(value, np.generic):
        return value.item()
    raise TypeError(f"diagnosis.json cannot hold a {type(value).__name__}")


def _array(kind: Any, value: Any) -> Any:
    if kind is np.ndarray or getattr(kind, "__origin__", None) is np.ndarray:
        return np.array([np.nan if x is None else x for x in value], dtype=np.float64)
    raise TypeError(f"cannot read a {kind}")


def _numbers(_: type) -> dict[str, Any]:
    return {"type": "array", "items": {"type": ["number", "null"]}}
