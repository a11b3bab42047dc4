"""Runs experiments; finished ones are kept as JSON in a folder, so that a run that was killed resumes."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import msgspec

from rwn.studies.made import Made, made
from rwn.studies.thesis.dependencies import fingerprint
from rwn.studies.thesis.experiment import Count, Experiment, Figure, Outcome, Row, Search, Settings
from rwn.studies.whole_file import write_whole

SHORT = 0.3  # minutes of one core


@dataclass(frozen=True, kw_only=True)
class Finished:
    """A finished experiment as kept on disk; `fingerprint` is of everything that it depends on, `seconds` of processor
    time are its thread's, which other work on the machine does not stretch; `seeds` as in `Settings`, None where
    the experiment has no such trainings."""

    name: str
    title: str
    choices: str
    rows: list[Row]
    figures: list[Figure]
    searches: list[Search]
    seconds: float
    count: Count
    fingerprint: str
    made: Made
    seeds: int | None = None


def run(
    experiments: Sequence[Experiment],
    out: Path,
    *,
    count: Count = "full",
    seeds: int = 1,
    jobs: int = 1,
    progress: Callable[[Experiment, float], None] = lambda *_: None,
) -> list[Finished]:
    """Results of the experiments, in order; those finished in `out` with the same fingerprint (for a quick run: in
    full, too) are read, not run.

    seeds: starts of the trainings that take all of the thesis's cycles.
    jobs: experiments at a time, in threads (the core releases the interpreter); results do not depend on it.
    progress(experiment, share done) is called now and then, with 1 at the end.
    """
    out.mkdir(parents=True, exist_ok=True)

    def one(experiment: Experiment) -> Finished:
        path, used = out / f"{experiment.name}.json", _count(experiment, count)
        starts = seeds if experiment.seed_minutes else None
        good: tuple[Count, ...] = ("quick", "full") if used == "quick" else (used,)
        done = read(path)
        if done is None or done.fingerprint not in [fingerprint(experiment.module, c, starts) for c in good]:
            done = _run_one(experiment, used, starts, progress)
            write_whole(path, msgspec.json.encode(done))
        progress(experiment, 1.0)
        return done

    longest_first = sorted(experiments, key=lambda e: -e.minutes_of(seeds))
    pool = ThreadPoolExecutor(jobs)
    try:
        found = dict(zip([e.name for e in longest_first], pool.map(one, longest_first), strict=True))
    finally:
        pool.shutdown(wait=False, cancel_futures=True)  # after Ctrl-C nobody waits for experiments that take minutes
    return [found[e.name] for e in experiments]


def _count(experiment: Experiment, count: Count) -> Count:
    """What is short anyway is not shortened."""
    return "full" if count == "quick" and experiment.minutes <= SHORT else count


def _run_one(
    experiment: Experiment, count: Count, seeds: int | None, progress: Callable[[Experiment, float], None]
) -> Finished:
    start = time.thread_time()
    outcome: Outcome = experiment.run(Settings(count, lambda share: progress(experiment, share), seeds or 1))
    return Finished(
        name=experiment.name,
        title=experiment.title,
        choices=experiment.choices,
        rows=outcome.rows,
        figures=outcome.figures,
        searches=outcome.searches,
        seconds=time.thread_time() - start,
        count=count,
        fingerprint=fingerprint(experiment.module, count, seeds),
        made=made(),
        seeds=seeds,
    )


def read(path: Path) -> Finished | None:
    """The result in a file; None where there is none, or it is damaged."""
    try:
        return msgspec.json.decode(path.read_bytes(), type=Finished)
    except (FileNotFoundError, msgspec.DecodeError):
        return None
