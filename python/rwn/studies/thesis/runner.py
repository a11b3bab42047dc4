"""Runs experiments; finished ones are kept as JSON in a folder, so that a run that was killed resumes."""

from __future__ import annotations

import hashlib
import sys
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import msgspec

from rwn import _core
from rwn.studies.thesis.experiment import Experiment, Figure, Outcome, Row, Settings


@dataclass(frozen=True, kw_only=True)
class Finished:
    """A finished experiment as kept on disk; `fingerprint` is of the code and settings that made it."""

    name: str
    title: str
    choices: str
    rows: list[Row]
    figures: list[Figure]
    seconds: float
    reduced: bool
    fingerprint: str


def run(
    experiments: Sequence[Experiment],
    out: Path,
    *,
    reduced: bool = False,
    jobs: int = 1,
    progress: Callable[[Experiment, float], None] = lambda *_: None,
) -> list[Finished]:
    """Results of the experiments, in order; those finished in `out` with the same code are read, not run.

    jobs: experiments at a time, in threads (the core releases the interpreter); results do not depend on it.
    progress(experiment, share done) is called now and then, with 1 at the end.
    """
    out.mkdir(parents=True, exist_ok=True)

    def one(experiment: Experiment) -> Finished:
        path = out / f"{experiment.name}.json"
        done = _read(path, _fingerprint(experiment, reduced=reduced))
        if done is None:
            done = _run_one(experiment, reduced, progress)
            _write(path, done)
        progress(experiment, 1.0)
        return done

    with ThreadPoolExecutor(jobs) as pool:
        return list(pool.map(one, experiments))


def _run_one(
    experiment: Experiment, reduced: bool, progress: Callable[[Experiment, float], None]
) -> Finished:
    start = time.perf_counter()
    outcome: Outcome = experiment.run(Settings(reduced, lambda share: progress(experiment, share)))
    return Finished(
        name=experiment.name,
        title=experiment.title,
        choices=experiment.choices,
        rows=outcome.rows,
        figures=outcome.figures,
        seconds=time.perf_counter() - start,
        reduced=reduced,
        fingerprint=_fingerprint(experiment, reduced=reduced),
    )


def _fingerprint(experiment: Experiment, *, reduced: bool) -> str:
    """Changes with the experiment's own file, the package's version and the count."""
    source = Path(sys.modules[experiment.run.__module__].__file__ or "").read_bytes()
    return hashlib.sha256(source + f"{_core.__version__} {reduced}".encode()).hexdigest()[:16]


def _read(path: Path, fingerprint: str) -> Finished | None:
    try:
        done = msgspec.json.decode(path.read_bytes(), type=Finished)
    except (FileNotFoundError, msgspec.DecodeError):
        return None
    return done if done.fingerprint == fingerprint else None


def _write(path: Path, done: Finished) -> None:
    """Complete or not at all: a killed run leaves no half file."""
    partial = path.with_suffix(".partial")
    partial.write_bytes(msgspec.json.encode(done))
    partial.replace(path)
