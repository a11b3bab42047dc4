"""Recordings in which the shaft is held, as by a brake, while it turns in others."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rwn.model.model import Model
from rwn.recording.inspection import Finding
from rwn.recording.recording import Recording
from rwn.simulate.recorded_run import run_of
from rwn.simulate.run import Run


def without_held(
    recordings: Sequence[Recording], model: Model, others: Sequence[Recording] = ()
) -> tuple[list[Recording], list[Finding]]:
    """The recordings that show a motion, and what is said of the rest; all of them where no other shows one.

    `others`: recordings of the same drive that may show a motion too. A shaft that stands tells no friction from a
    brake. Raises InputError where a recording does not fit the model.
    """
    if model.drive.coefficients:
        return list(recordings), []
    runs = [run_of(r, model) for r in recordings]
    held = [not run.moves for run in runs]
    if not any(held) or (all(held) and not any(run_of(r, model).moves for r in others)):
        return list(recordings), []
    found = [held_finding(run, model) for run, still in zip(runs, held, strict=True) if still]
    return [r for r, still in zip(recordings, held, strict=True) if not still], found


def held_finding(run: Run, model: Model) -> Finding:
    """What is said of a run in which nothing moves."""
    torque = ""
    if model.drive.force or run.current.size:
        most = float(np.percentile(np.abs(model.drive.driving_torque(model.motor, run.current, run.input)), 99.5))
        torque = f", under up to {most:.3g} {'N' if model.linear else 'N m'}"
    return Finding(
        kind="held-shaft", recording=run.name, signals=(), count=len(run.time), done="left out where others move",
        words=f"nothing moves in it{torque}, as with a brake on",
    )  # fmt: skip
