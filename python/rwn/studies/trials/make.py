"""Makes a set of blind trials: folders to diagnose, and the sealed answers."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

from rwn.studies.trials.dossier import write_trial
from rwn.studies.trials.plan import FIRST_TEST_SEED, SPLITS, Plan, plans, split_of
from rwn.studies.trials.seal import ANSWERS, seal
from rwn.studies.trials.trial import make_trial
from rwn.studies.trials.workers import workers

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
    split: str | None = None,
    jobs: int = 2,
    progress: Progress | None = None,
) -> str:
    """Writes `count` trials of `seed` to `out` and returns the SHA-256 of the sealed answers.

    An interrupted call continues where it stopped. Raises ValueError for a seed of the other split, and
    FileExistsError where a finished set lies already.
    """
    split = check_split(seed, split)
    if seed < 0 or count < 1:
        raise ValueError(
            f"seed {seed} and count {count}: the seed must not be negative, the count at least 1"
        )
    if (out / ANSWERS).exists():
        raise FileExistsError(f"{out} already holds a finished set of trials; choose another folder")
    planned = plans(seed, count)
    work = out / WORK
    work.mkdir(parents=True, exist_ok=True)
    _same_set(work / "set.json", {"seed": seed, "count": count})
    left = [plan for plan in planned if not (work / f"{plan.name}.json").exists()]
    done = count - len(left)
    with workers(jobs) as pool:
        for number, plan in enumerate(pool.map(_make_one, left, [out] * len(left)), start=done + 1):
            if progress is not None:
                progress(number, count, plan.name)
    answers = {plan.name: json.loads((work / f"{plan.name}.json").read_text()) for plan in planned}
    digest = seal(out, {"seed": seed, "split": split, "count": count, "answers": answers})
    shutil.rmtree(work)
    return digest


def _same_set(path: Path, wanted: dict[str, int]) -> None:
    if path.exists() and json.loads(path.read_text()) != wanted:
        raise FileExistsError(
            f"{path.parent.parent} holds an unfinished set of another seed or count; remove it"
        )
    path.write_text(json.dumps(wanted))


def _make_one(plan: Plan, out: Path) -> Plan:
    trial = make_trial(plan)
    folder, half = out / plan.name, out / WORK / plan.name
    for leftover in (folder, half):
        shutil.rmtree(leftover, ignore_errors=True)
    write_trial(half, trial)
    half.rename(folder)
    answer: dict[str, Any] = trial.answer
    (out / WORK / f"{plan.name}.tmp").write_text(json.dumps(answer))
    (out / WORK / f"{plan.name}.tmp").rename(out / WORK / f"{plan.name}.json")
    return plan
