"""Is a recording usable, and does it fit the model? Every refusal is one line with the row and the remedy."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from rwn.errors import InputError
from rwn.model.drives import KINDS
from rwn.model.files import model_of
from rwn.model.initial_state import initial_state_of
from rwn.model.model import Model
from rwn.recording.check import MIN_SAMPLES, SMALLEST, check_samples
from rwn.recording.columns import NOT_USED
from rwn.recording.copies import is_piece
from rwn.recording.recording import Recording, read_recording
from rwn.recording.signals import COLUMNS, SIGNALS, TIME

LONGEST_SHIFT = 40  # samples up to which a delay of a channel is looked for

# Part of a run that a delay or time constant of a sensor may last: beyond it too little would be left to compare. In a
# run so short that it is less, LONGEST_SHIFT samples are allowed, so that `diagnose` reads what it wrote.
_SHARE = 0.1


def check_recording(recording: Recording, model: Model, *, compared: bool = True) -> Recording:
    """Its samples are usable, it has the signals that the model needs, in its units, and they move. Raises InputError.

    `compared`: with something measured to compare a simulation with; its input alone will do otherwise.
    """
    where = recording.source or recording.name
    drive = model.drive
    check_samples(
        recording.time, recording.signals, where=where, row=lambda k: f"{where}, sample {k + 1}",
        fewest=MIN_SAMPLES if compared else 2,
    )  # fmt: skip
    if drive.input not in recording.signals:
        raise _missing(recording, drive.input, f"the input of a drive of kind '{model.kind}'")
    if compared and not any(name in recording.signals for name in drive.outputs):
        raise _missing(recording, drive.outputs[0], "something measured to compare with")
    if recording.linear != model.linear and any(name in recording.signals for name in ("speed", "position")):
        has, wants = ("linear", "rotary") if recording.linear else ("rotary", "linear")
        raise InputError(
            f"speed or position is in {has} units, the model is {wants}",
            where=where,
            expected="rad and rad/s" if wants == "rotary" else "m and m/s",
            fix="set linear in [motor], or map the column with a scale such as 0.01 m/rad",
        )
    _check_sensors(recording, model, where)
    moved = _check_movement(recording, model, where) if compared else ()
    warnings = (*recording.warnings, *moved)
    return replace(recording, warnings=tuple(dict.fromkeys(warnings)))


def _check_sensors(recording: Recording, model: Model, where: str) -> None:
    step = float(np.median(np.diff(recording.time)))
    most = max(_SHARE * recording.duration, min(LONGEST_SHIFT * step, 0.8 * recording.duration))
    layout = model.recording
    for kind, times in (("delays", layout.delays), ("filters", layout.filters)):
        for signal, time in times.items():
            if signal in recording.signals and not abs(time) <= most * (1.0 + 1e-9):
                raise InputError(
                    f"{time:g} s, where {where} lasts {recording.duration:g} s",
                    where=f"{model.source or 'model'}, [recording] {kind}.{signal}",
                    expected=f"at most {most:.3g} s: a tenth of a recording, or {LONGEST_SHIFT} rows",
                    fix='correct the value or its unit: a number is in s, "4 ms" is text',
                )


def _missing(recording: Recording, name: str, why: str) -> InputError:
    where = recording.source or recording.name
    left = [said.removeprefix(f"{where}: ") for said in recording.warnings if said.startswith(f"{where}: {NOT_USED}")]
    has = "; ".join([", ".join(recording.signals) or "no signal at all", *left])
    unit = SIGNALS[name].unit or SIGNALS[name].linear_unit
    return InputError(
        f"there is no '{name}' ({why}); it has {has}",
        where=where,
        expected=f"a column '{name} [{unit}]'",
        fix=f"add it, or map it under [recording.columns] in the model file{_other_kind(recording, name)}",
    )


def _other_kind(recording: Recording, name: str) -> str:
    """Where the input `name` is missing and that of a drive of another kind is there: perhaps that is what drives."""
    others = {drive.input: kind for kind, drive in KINDS.items() if drive.input != name}
    if name not in (drive.input for drive in KINDS.values()):
        return ""
    return "".join(f"; or kind = '{kind}', if the {i} drives" for i, kind in others.items() if i in recording.signals)


def _check_movement(recording: Recording, model: Model, where: str) -> tuple[str, ...]:
    drive = model.drive
    for name, values in recording.signals.items():
        if name in drive.outputs and np.ptp(values) == 0.0:
            raise InputError(
                f"'{name}' is constant ({values[0]:g})",
                where=where,
                expected="a signal that moves",
                fix="check that the sensor is connected, or leave the column out",
            )
    values = recording.signals[drive.input]
    if np.ptp(values) > 0.0:
        return ()
    if abs(values[0]) < SMALLEST and not initial_state_of(recording.time, recording.signals, model).in_motion:
        raise InputError(
            f"'{drive.input}' is zero throughout, from rest",
            where=where,
            expected="an input that drives",
            fix='record with excitation, or set initial = "estimate" under [recording]',
        )
    return (f"{where}: '{drive.input}' is constant: a single step says little about what is missing",)


def read_recordings(sources: Any, model: Model | str | Path, *, compared: bool = True) -> list[Recording]:
    """Read and check every recording against the model.

    `sources`: one or several of paths, tables in Python (see `read_recording`) and recordings; `model`: a model or its
    file. `compared`: see `check_recording`. Raises InputError, also for a recording that is given twice.
    """
    model = model_of(model)
    needed = COLUMNS if compared else (TIME.name, model.drive.input)
    read = (
        one if isinstance(one, Recording) else read_recording(one, layout=model.recording, needed=needed)
        for one in _listed(sources)
    )
    recordings = [check_recording(recording, model, compared=compared) for recording in read]
    refuse_doubles(recordings)
    return recordings


def recordings_to_fit(sources: Any, model: Model) -> list[Recording]:
    """As `read_recordings`, at least one. Raises InputError."""
    recordings = read_recordings(sources, model)
    if not recordings:
        raise InputError(
            "no recording is given", where="recordings", expected="at least one", fix="pass the recordings to fit to"
        )
    return recordings


def refuse_doubles(recordings: Sequence[Recording]) -> None:
    """Raises InputError where one recording is another or a piece of it, whatever they are called and wherever they
    are."""
    for k, later in enumerate(recordings):
        for earlier in recordings[:k]:
            part, whole = sorted((later, earlier), key=len)
            if is_piece(part, whole):
                how = "the same recording is" if len(part) == len(whole) else "the samples of this recording are"
                raise InputError(
                    f"{how} given twice, as {_named(earlier)} too",
                    where=_named(later),
                    expected="each recording once",
                    fix="remove one of them: a recording cannot judge itself",
                )


def _named(recording: Recording) -> str:
    return recording.source or recording.name


def _listed(sources: Any) -> list[Any]:
    """The sources one by one: a path, a table or a recording stands for itself."""
    if isinstance(sources, list | tuple) or hasattr(sources, "__next__"):
        return list(sources)
    return [sources]
