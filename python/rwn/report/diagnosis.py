"""What a diagnosis found, as plain data: made by `diagnose`, drawn by the report, kept in diagnosis.json."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

import msgspec
import numpy as np
from numpy.typing import NDArray

Verdict = Literal[
    "missing-physics", "adequate", "unexplained", "insufficient-excitation", "recording-mistake"
]
Slot = Literal[
    "response", "residual-time", "residual-speed", "residual-angle", "torque-speed", "spectrum", "other"
]
Role = Literal["measured", "nominal", "refitted", "corrected", "before", "after", "reference", "noise-floor"]
Array = NDArray[np.float64]

BELIEVABLE = 4.0  # declared standard deviations, beyond which a parameter is not merely off
RECORDING = "recording"  # the equation of a mistake in the recordings
NEAREST = 0.5  # probability of being the whole, up to which a name is only the nearest one; a proved one that leaves
# more than noise has no more


@dataclass(frozen=True, kw_only=True)
class Estimate:
    """A number with its unit and 95 % interval (`None`: not estimated, e.g. fixed by the user)."""

    value: float
    unit: str
    interval: tuple[float, float] | None = None


@dataclass(frozen=True, kw_only=True)
class FoundEffect:
    """One physics that the nominal model lacks."""

    name: str
    equation: str  # "mechanical" | "electrical" | "actuator" | "sensor" | "recording"
    probability: float
    parameters: Mapping[str, Estimate] = field(default_factory=dict)
    formula: str = ""  # as in the effect table: "T sign(w)"
    meaning: str = ""  # one sentence for people: "dry friction that does not depend on speed"


@dataclass(frozen=True, kw_only=True)
class Alternative:
    """Another explanation of the same recordings, with its probability."""

    effects: tuple[str, ...]
    probability: float
    separated_by: str = ""  # the experiment that would tell it from the first


@dataclass(frozen=True, kw_only=True)
class Region:
    """The samples with `low <= coordinate < high`; their share of the residual energy and of the samples."""

    coordinate: str  # "speed", "angle", "current", "direction", "acceleration", "time"
    low: float
    high: float
    unit: str
    share: float
    samples_share: float
    name: str = ""  # "low speed", "reversals"


@dataclass(frozen=True, kw_only=True)
class Location:
    """The equation that carries unknown input, and the regions where the mismatch's energy sits."""

    equation: str = ""
    regions: tuple[Region, ...] = ()
    description: str = ""  # "a torque that depends on angle, 14 periods per revolution, 3 mN m"


@dataclass(frozen=True, kw_only=True)
class FittedParameter:
    """A nominal parameter: as given, its declared relative standard deviation (0: exact), and as refitted."""

    nominal: float
    uncertainty: float
    refitted: Estimate  # the nominal structure alone
    corrected: Estimate | None = None  # together with the found effects

    @property
    def moved(self) -> float:
        """By how many declared standard deviations the refit moved it, relative or in its logarithm; 0 where exact."""
        if self.uncertainty == 0.0 or self.nominal <= 0.0:
            return 0.0
        ratio = self.refitted.value / self.nominal
        return min(abs(ratio - 1.0), abs(math.log(ratio)) if ratio > 0.0 else math.inf) / self.uncertainty


@dataclass(frozen=True, kw_only=True)
class NominalFit:
    """The nominal structure refitted within its declared uncertainty."""

    parameters: Mapping[str, FittedParameter] = field(default_factory=dict)
    status: str = "converged"
    advice: str = ""


@dataclass(frozen=True, kw_only=True)
class HeldoutRow:
    """Free-run rms error on a recording not used for fitting; `gain` = 1 - corrected / refitted."""

    recording: str
    region: str  # "all", or the name of a region
    signal: str
    unit: str
    samples: int
    nominal: float
    refitted: float
    corrected: float | None
    noise_floor: float | None
    gain: float | None = None
    gain_interval: tuple[float, float] | None = None  # 95 %, block bootstrap


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
    location: Location = field(default_factory=Location)
    nominal_fit: NominalFit = field(default_factory=NominalFit)
    heldout: tuple[HeldoutRow, ...] = ()
    curves: tuple[Plot, ...] = ()
    warnings: tuple[str, ...] = ()
    next_experiment: str = ""
    adequate_probability: float | None = None  # that nothing is missing
    whole: float = 1.0  # probability that what is named is all that is missing, by what it leaves; see NEAREST
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
