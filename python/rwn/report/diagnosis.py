"""What a diagnosis found, as plain data: made by `diagnose`, drawn by the report, kept in diagnosis.json."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

import msgspec
import numpy as np
from numpy.typing import NDArray

from rwn.decide.account import Acting, Remainder
from rwn.decide.verdict import Verdict
from rwn.locate.regions import Region
from rwn.name.found_effect import FoundEffect
from rwn.prove.heldout import HeldoutRow
from rwn.recording.inspection import Finding
from rwn.report.nominal_fit import NominalFit

Slot = Literal[
    "response", "residual-time", "residual-speed", "residual-angle", "torque-speed", "spectrum", "other"
]
Role = Literal["measured", "nominal", "refitted", "corrected", "before", "after", "reference", "noise-floor"]
Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Alternative:
    """Another explanation of the same recordings, with its probability."""

    effects: tuple[str, ...]
    probability: float
    separated_by: str = ""  # the experiment that would tell it from the first


@dataclass(frozen=True, kw_only=True)
class Location:
    """The equation that carries unknown input, and the regions where the mismatch's energy sits."""

    equation: str = ""
    regions: tuple[Region, ...] = ()
    description: str = ""  # "a torque that depends on angle, 14 periods per revolution, 3 mN m"


@dataclass(frozen=True, kw_only=True)
class Trace:
    """One line (or cloud) of a plot; `low`/`high` shade a band around it; NaN breaks the line."""

    name: str
    role: Role
    x: Array
    y: Array
    low: Array | None = None
    high: Array | None = None
    points: bool = False  # a cloud instead of a line


@dataclass(frozen=True, kw_only=True)
class Mark:
    """A stretch of the x axis to point at: the located region."""

    low: float
    high: float
    label: str


@dataclass(frozen=True, kw_only=True)
class Plot:
    """One picture of the report, in SI units; the report picks prefixes. `slot` says where it belongs."""

    slot: Slot
    title: str
    x_label: str
    x_unit: str
    y_label: str
    y_unit: str
    traces: tuple[Trace, ...]
    marks: tuple[Mark, ...] = ()
    note: str = ""
    log_y: bool = False


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
class Diagnosis:
    """The verdict, what it rests on, and the curves that show it."""

    verdict: Verdict
    equation: str = ""
    effects: tuple[FoundEffect, ...] = ()
    set: tuple[str, ...] = ()  # names that these recordings cannot tell apart, the first is the first name
    beneath: Beneath | None = None  # where the verdict is recording-mistake
    alternatives: tuple[Alternative, ...] = ()
    findings: tuple[Finding, ...] = ()  # what the check of the recordings found
    location: Location = field(default_factory=Location)
    nominal_fit: NominalFit = field(default_factory=NominalFit)
    heldout: tuple[HeldoutRow, ...] = ()
    curves: tuple[Plot, ...] = ()
    warnings: tuple[str, ...] = ()
    next_experiment: str = ""
    adequate_probability: float | None = None  # that nothing is missing
    account: tuple[Acting, ...] = ()  # the effects of the leading explanation, stated or not
    remainder: Remainder = field(default_factory=Remainder)  # what the stated effects leave
    sources: tuple[Source, ...] = ()
    command: str = ""
    seed: int = 0
    version: str = ""
    elapsed: float = 0.0  # [s]; like command, left out of the JSON
    stand_in: str = ""  # what stands in corrected.toml for what has no name: "a wavelet network, a torque over speed"
    corrected: Any = None  # the corrected rwn.Model; written to corrected.toml, left out of the JSON

    def to_json(self) -> bytes:
        """`diagnosis.json`: what depends on input and seed alone. NaN in a curve becomes null."""
        plain = msgspec.to_builtins(
            _without(self, ("command", "corrected", "elapsed")), enc_hook=_encode_array
        )
        return msgspec.json.format(msgspec.json.encode(plain), indent=1) + b"\n"

    @classmethod
    def from_json(cls, text: bytes | str) -> Diagnosis:
        """The inverse of `to_json`; raises `msgspec.ValidationError` with the path of what is wrong."""
        return msgspec.convert(msgspec.json.decode(text), cls, dec_hook=_decode_array)


def _without(diagnosis: Diagnosis, names: Sequence[str]) -> dict[str, Any]:
    return {key: value for key, value in vars(diagnosis).items() if key not in names}


def _encode_array(value: Any) -> Any:
    if isinstance(value, np.ndarray):
        return [float(x) if np.isfinite(x) else None for x in value]
    if isinstance(value, np.generic):
        return value.item()
    raise TypeError(f"diagnosis.json cannot hold a {type(value).__name__}")


def _decode_array(kind: Any, value: Any) -> Any:
    if kind is np.ndarray or getattr(kind, "__origin__", None) is np.ndarray:
        return np.array([np.nan if x is None else x for x in value], dtype=np.float64)
    raise TypeError(f"cannot read a {kind}")
