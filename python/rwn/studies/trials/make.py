"""Makes a set of blind trials: folders to diagnose, and the sealed answers."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, Protocol, TypeVar

from rwn.studies.trials.bench_trials.plan import JUDGED_BY
from rwn.studies.trials.bench_trials.plan import plans as bench_plans
from rwn.studies.trials.bench_trials.trial import make_bench_trial
from rwn.studies.trials.damaged import reading
from rwn.studies.trials.judges import JUDGES
from rwn.studies.trials.plan import FIRST_TEST_SEED, SPLITS, plans, split_of
from rwn.studies.trials.seal import ANSWERS, seal
from rwn.studies.trials.trial import Trial, make_trial
from rwn.studies.trials.trial_files import write_trial
from rwn.studies.trials.workers import workers
from rwn.studies.whole_file import write_whole


class Planned(Protocol):
    """A plan; its name is the name of the trial's folder."""

    @property
    def name(self) -> str: ...


P = TypeVar("P", bound=Planned)
Progress = Callable[[int, int, str], None]

WORK = ".making"  # answers of finished trials while the set is incomplete


def check_split(seed: int, split: str | None) -> str:
    """The split of this seed; raises ValueError if another one was asked for."""
    found = split_of(seed)
    if split is not None and split not in SPLITS:
        raise ValueError(f"split is {split!r}; it must be one of {', '.join(SPLITS)}")
    if split is not None and split != found:
        raise ValueError(
            f"seed {seed} belongs to the {found} split; seeds from {FIRST_TEST_SEED} on are for tests, "
            "smaller ones for development"
        )
    return found


def make(
    seed: int,
    count: int,
    out: Path,
    *,
    first: int | None = None,
    split: str | None = None,
    jobs: int = 2,
    progress: Progress | None = None,
) -> str:
    """Writes `count` trials of `seed` to `out` and returns the SHA-256 of the sealed answers.

    `first`: only so many of them, from the first on; what they hold is spread over the whole count. An interrupted call
    continues where it stopped. Raises ValueError for a seed of the other split, and FileExistsError where a finished
    set lies already.
    """
    about = _about(seed, count, split, first)
    return _make(about, plans(seed, count), make_trial, out, jobs=jobs, progress=progress)


def make_bench(
    seed: int,
    count: int,
    out: Path,
    *,
    first: int | None = None,
    split: str | None = None,
    judge: str | None = None,
    jobs: int = 2,
    progress: Progress | None = None,
) -> str:
    """The same with bench trials. `judge` alone holds the truth where it is given, else each has its share.

    Raises ValueError as well for a judge that is not known, or that cannot run here.
    """
    about = _about(seed, count, split, first) | {"bench": True} | ({"judge": judge} if judge else {})
    if judge is not None and judge not in JUDGES:
        raise ValueError(f"judge is {judge!r}; it must be one of {', '.join(JUDGES)}")
    for name in JUDGED_BY if judge is None else (judge,):
        if missing := JUDGES[name].missing():
            raise ValueError(missing)
    planned = bench_plans(seed, count, judge=judge)
    return _make(about, planned, make_bench_trial, out, jobs=jobs, progress=progress)


def _about(seed: int, count: int, split: str | None, first: int | None) -> dict[str, Any]:
    split = check_split(seed, split)
    if seed < 0 or count < 1:
        raise ValueError(
            f"seed {seed} and count {count}: the seed must not be negative, the count at least 1"
        )
    if first is not None and not 1 <= first <= count:
        raise ValueError(f"the first {first} of {count} trials: give a number from 1 to {count}")
    return {"seed": seed, "split": split, "count": count} | ({"first": first} if first is not None else {})


def _make(
    about: dict[str, Any],
    planned: Sequence[P],
    make_one: Callable[[P], Trial],
    out: Path,
    *,
    jobs: int,
    progress: Progress | None,
) -> str:
    work = out / WORK
    if (out / ANSWERS).exists():
        shutil.rmtree(work, ignore_errors=True)  # the answers unsealed: a run was killed before it had removed them
        raise FileExistsError(f"{out} already holds a finished set of trials; choose another folder")
    work.mkdir(parents=True, exist_ok=True)
    _same_set(work / "set.json", {key: value for key, value in about.items() if key not in ("split", "first")})
    planned = planned[: about.get("first")]
    left = [plan for plan in planned if not (work / f"{plan.name}.json").exists()]
    done = len(planned) - len(left)
    with workers(jobs) as pool:
        made = pool.map(_make_one, left, [make_one] * len(left), [out] * len(left))
        for number, plan in enumerate(made, start=done + 1):
            if progress is not None:
                progress(number, len(planned), plan.name)
    answers = {}
    for plan in planned:
        with reading(work / f"{plan.name}.json"):
            answers[plan.name] = json.loads((work / f"{plan.name}.json").read_text())
    digest = seal(out, about | {"answers": answers})
    shutil.rmtree(work)
    return digest


def _same_set(path: Path, wanted: dict[str, Any]) -> None:
    with reading(path):
        other = path.exists() and json.loads(path.read_text()) != wanted
    if other:
        raise FileExistsError(
            f"{path.parent.parent} holds an unfinished set of another seed, count or kind; remove it"
        )
    if not path.exists():
        write_whole(path, json.dumps(wanted).encode())


def _make_one(plan: P, make_one: Callable[[P], Trial], out: Path) -> P:
    trial = make_one(plan)
    folder, half = out / plan.name, out / WORK / plan.name
    for leftover in (folder, half):
        shutil.rmtree(leftover, ignore_errors=True)
    write_trial(half, trial)
    half.rename(folder)
    answer: dict[str, Any] = trial.answer
    write_whole(out / WORK / f"{plan.name}.json", json.dumps(answer).encode())
    return plan
