"""Diagnoses every trial of a folder, in a few processes; what is done already is not done again."""

from __future__ import annotations

import shutil
import traceback
from collections.abc import Callable
from concurrent.futures import as_completed
from pathlib import Path

from rwn.studies.trials.adapter import diagnose_trial
from rwn.studies.trials.workers import workers

Progress = Callable[[int, int, str], None]
Diagnose = Callable[[Path, Path], None]


def trial_folders(folder: Path) -> list[Path]:
    """The trials in `folder`; raises ValueError where there is none."""
    found = sorted(path.parent for path in folder.glob("*/model.toml"))
    if not found:
        raise ValueError(
            f"{folder} holds no trials (folders with a model.toml); make some with `rwn trials make`"
        )
    return found


def out_of(trial: Path, results: Path | None) -> Path:
    """Where the diagnosis of a trial goes: beside it, or in `results`."""
    return trial / "out" if results is None else results / trial.name


def run(
    folder: Path,
    *,
    results: Path | None = None,
    jobs: int = 2,
    progress: Progress | None = None,
    diagnose: Diagnose = diagnose_trial,
) -> list[str]:
    """Writes a diagnosis for every trial that has none yet; returns the names of those that failed.

    A failure leaves error.txt and is tried again by the next call.
    """
    trials = trial_folders(folder)
    left = [trial for trial in trials if not (out_of(trial, results) / "diagnosis.json").exists()]
    failed: list[str] = []
    done = len(trials) - len(left)
    with workers(jobs) as pool:
        jobs_left = {pool.submit(_one, trial, out_of(trial, results), diagnose): trial for trial in left}
        for job in as_completed(jobs_left):
            trial = jobs_left[job]
            done += 1
            if not job.result():
                failed.append(trial.name)
            if progress is not None:
                progress(done, len(trials), trial.name)
    return sorted(failed)


def _one(trial: Path, out: Path, diagnose: Diagnose) -> bool:
    """Works in a folder of its own and moves it into place, so that a killed run leaves no half result."""
    half = out.with_name(out.name + ".tmp")
    shutil.rmtree(half, ignore_errors=True)
    half.mkdir(parents=True)
    try:
        diagnose(trial, half)
    except Exception:  # one trial must not stop the others; it counts as wrong
        out.mkdir(parents=True, exist_ok=True)
        (out / "error.txt").write_text(traceback.format_exc(), encoding="utf-8")
        shutil.rmtree(half)
        return False
    shutil.rmtree(out, ignore_errors=True)
    half.rename(out)
    return True
