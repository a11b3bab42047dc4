"""Recordings in which the shaft is held, as by a brake, while it turns in others."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from rwn.model.drives.drive import Drive
from rwn.model.model import Model
from rwn.recording.inspection import Finding
from rwn.recording.recording import Recording
from rwn.simulate.recorded_run import run_of
from rwn.simulate.run import Run

Array = NDArray[np.float64]


def without_held(
    recordings: Sequence[Recording], model: Model, others: Sequence[Recording] = ()
) -> tuple[list[Recording], list[Finding]]:
    """The recordings that show a motion, and what is said of the rest; all of them where no other shows one.

    `others`: recordings of the same drive that may show a motion too. A shaft that stands tells no friction from a
    brake; held is one that stands under more than what moves it in the median. Raises InputError where a recording
    does not fit the model.
    """
    if model.drive.coefficients:
        return list(recordings), []
    runs = [run_of(r, model) for r in recordings]
    moving = [run for run in (*runs, *(run_of(r, model) for r in others)) if run.moves]
    turned = [np.abs(run.input[run.turning]) for run in moving if run.turning.any()]
    if not turned or all(run.moves for run in runs):
        return list(recordings), []
    usual = float(np.median(np.concatenate(turned)))  # a motion that is too small to be seen is of a smaller input
    held = [not run.moves and _most(np.abs(run.input)) > usual for run in runs]
    found = [held_finding(run, model) for run, still in zip(runs, held, strict=True) if still]
    return [r for r, still in zip(recordings, held, strict=True) if not still], found


def withstood(runs: Sequence[Run], drive: Drive, motor: Mapping[str, float]) -> float:
    """The largest driving torque [N m] (force [N]) of runs; 0 where nothing tells it. `motor`: nominal values."""
    told = [run for run in runs if drive.force or run.current.size]
    return max((_most(np.abs(drive.driving_torque(motor, run.current, run.input))) for run in told), default=0.0)


def _most(sizes: Array) -> float:
    return float(np.percentile(sizes, 99.5))  # but for stray samples, as of a motion


def held_finding(run: Run, model: Model) -> Finding:
    """What is said of a run in which nothing moves."""
    most = withstood([run], model.drive, model.motor)
    torque = f", under up to {most:.3g} {'N' if model.linear else 'N m'}" if most else ""
    return Finding(
        kind="held-shaft", recording=run.name, signals=(), count=len(run.time), done="left out where others move",
        words=f"nothing moves in it{torque}, as with a brake on",
    )  # fmt: skip
