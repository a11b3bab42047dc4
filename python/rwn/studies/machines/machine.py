"""What a real machine is to `rwn evidence`: recordings to fit, recordings to judge by, and the figures to beat."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rwn.diagnose import diagnose
from rwn.errors import InputError
from rwn.model.files import read_model
from rwn.model.model import Model
from rwn.recording.recording import Recording
from rwn.recording.signals import SIGNALS, si_unit
from rwn.recording.units import factor, has_dimension
from rwn.report.diagnosis import Diagnosis

Array = NDArray[np.float64]
Say = Callable[[str], None]


@dataclass(frozen=True, kw_only=True)
class Error:
    """One error on recordings not fitted: of the nominal, refitted and corrected model, and the best known."""

    measure: str  # with its unit: "position, PULSES [mm]"
    nominal: float
    refitted: float
    corrected: float | None
    published: str = ""  # by whom
    wanted: float | None = None  # the figure to reach
    by_hand: float | None = None  # of the best physical fit made by hand (`hand_fit`)


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """What rwn made of one set of recordings."""

    machine: str
    begins_with: str  # the nominal model in words
    found: Diagnosis
    errors: tuple[Error, ...]
    notes: tuple[str, ...] = ()  # what else the data say


@dataclass(frozen=True, kw_only=True)
class Machine:
    """A machine: where its recordings are below the folder of data, and how they are judged."""

    name: str
    folder: str
    source: str
    run: Callable[[Path, Say], tuple[Outcome, ...]]


def nominal_model(name: str) -> Model:
    """A nominal model of this package: NAME.toml."""
    return read_model(Path(__file__).parent / f"{name}.toml")


def judged(
    machine: str, begins_with: str, model: Model, fitted: Sequence[Recording], heldout: Sequence[Recording], say: Say
) -> Outcome:
    """A diagnosis with rwn's general settings; errors are added by the caller."""
    say(f"{machine}: diagnosing {', '.join(r.name for r in fitted)}")
    found = diagnose(list(fitted), model, heldout=list(heldout))
    return Outcome(machine=machine, begins_with=begins_with, found=found, errors=())


def error_of(
    found: Diagnosis,
    recording: str,
    signal: str,
    measure: str,
    *,
    scale: float = 1.0,
    published: str = "",
    wanted: float | None = None,
) -> Error:
    """The rms row of one held-out recording, `scale` times its number in SI."""
    row = next(r for r in found.heldout if (r.recording, r.signal, r.region) == (recording, signal, "all"))
    known = [si_unit(SIGNALS[signal], linear) for linear in (False, True)] if signal in SIGNALS else []
    scale *= next((factor(row.unit, si, where=recording) for si in known if has_dimension(row.unit, si, where="")), 1.0)
    corrected = None if row.corrected is None else scale * row.corrected
    return Error(
        measure=measure, nominal=scale * row.nominal, refitted=scale * row.refitted, corrected=corrected,
        published=published, wanted=wanted,
    )  # fmt: skip


def cut(recording: Recording, first: int, last: int | None = None) -> Recording:
    """Samples first..last of a recording, time from 0."""
    part = slice(first, last)
    time = recording.time[part]
    signals = {name: values[part] for name, values in recording.signals.items()}
    return Recording(name=recording.name, time=time - time[0], signals=signals, linear=recording.linear)


def data_file(folder: Path, name: str) -> Path:
    """A file of the data; InputError where it is not here."""
    path = folder / name
    if not path.is_file():
        raise InputError(
            "a recording of this machine is not here",
            where=path,
            expected="the folder of real recordings",
            fix="give it with --data; the recordings are not part of rwn",
        )
    return path
