"""Marks one diagnosis of a bench trial: every statement of it, not its first name alone."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rwn.studies.trials.adapter import heldout_files, refitted_file, simulated_file
from rwn.studies.trials.bench_trials.also_true import also_true
from rwn.studies.trials.bench_trials.imperfections import held
from rwn.studies.trials.bench_trials.plan import BACKGROUND_ALONE, NOTHING
from rwn.studies.trials.damaged import reading
from rwn.studies.trials.effects import known_as
from rwn.studies.trials.grade import (
    LARGEST_SET,
    NO_RESULT,
    Estimated,
    answers_of,
    clean_speed,
    load_answers,
    parameter_estimates,
    without_mistake,
)
from rwn.studies.trials.run import out_of, trial_folders
from rwn.studies.trials.said import said_in
from rwn.studies.trials.trial_files import read_speed

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

WORSE = 1.01  # times the error of the refitted model, noise included
SPIKE = 4.0  # times what nine tenths of a recording's noise stay within: 6.6 deviations of what is normal


@dataclass(frozen=True, kw_only=True)
class Stated:
    """A name with its probability, or "nothing is missing" under the name "" """

    name: str
    probability: float
    right: bool


@dataclass(frozen=True, kw_only=True)
class BenchGrade:
    """`visibility` is that of the clearest named effect alone, 1 where there is none."""

    case: str
    mode: str
    judge: str
    kinds: tuple[str, ...]
    background: str
    truth: tuple[str, ...]
    visibility: float
    verdict: str
    names: tuple[str, ...]
    stated: tuple[Stated, ...]
    right: bool
    parameters: tuple[Estimated, ...] = ()
    worse: tuple[bool, ...] = ()  # by held-out recording: the corrected model is worse than the refitted one

    @property
    def named(self) -> bool:
        """Something that has a name is missing."""
        return self.mode not in (NOTHING, BACKGROUND_ALONE)

    def wrong_above(self, probability: float) -> tuple[str, ...]:
        """Names that are not true and that are stated with more than this."""
        return tuple(s.name for s in self.stated if s.name and not s.right and s.probability > probability)


@dataclass(frozen=True, kw_only=True)
class BenchGraded:
    seeds: tuple[int, ...]
    split: str | None
    grades: list[BenchGrade]


def is_bench(folder: Path) -> bool:
    """Whether the answers in this folder are those of bench trials."""
    about, answers = load_answers(folder)
    return bool(about.get("bench")) or all("imperfections" in answer for answer in answers.values())


def grade_folders(folders: Sequence[Path], *, results: Path | None = None) -> BenchGraded:
    """Several sets as one; with more than one, `results` holds a folder for each, of the same name.

    Raises ValueError where development and test sets, or bench trials and others, would be mixed, or one seed counted
    twice.
    """
    seeds: list[int] = []
    splits: set[str | None] = set()
    grades: list[BenchGrade] = []
    for folder in folders:
        about, answers = load_answers(folder)
        if not is_bench(folder):
            raise ValueError(f"{folder} holds no bench trials, other folders do; score each kind alone")
        seeds += [about["seed"]] if "seed" in about else []
        splits.add(about.get("split"))
        several = len(folders) > 1
        into = results / folder.name if results and several else results
        found = []
        for trial in trial_folders(folder):
            if trial.name in answers:
                with reading(answers_of(trial)):
                    found.append(grade(answers[trial.name], trial, out_of(trial, into)))
        grades += [replace(g, case=f"{folder.name}/{g.case}") if several else g for g in found]
    if len(splits) > 1:
        raise ValueError("the folders mix development and test sets (or open answers); score each kind alone")
    if len(set(seeds)) < len(seeds):
        raise ValueError(f"two folders hold the same seed (seeds {', '.join(map(str, seeds))}); give each set once")
    return BenchGraded(seeds=tuple(seeds), split=splits.pop(), grades=grades)


def grade(answer: Mapping[str, Any], trial: Path, out: Path) -> BenchGrade:
    """A trial without a diagnosis states nothing."""
    said: dict[str, Any] = {"verdict": NO_RESULT}
    if (out / "diagnosis.json").exists():
        said = said_in(out / "diagnosis.json")
    truth = tuple(str(effect["name"]) for effect in answer["effects"])
    kinds = tuple(str(each["kind"]) for each in answer["imperfections"])
    faults = [e for e in said.get("effects", []) if e["equation"] == "recording"]
    beneath = without_mistake(said)[1]
    effects = beneath.get("effects", []) if beneath["verdict"] == "missing-physics" else []
    names = tuple(str(effect["name"]) for effect in effects)
    meant, harmless = _accepted(answer, truth)
    candidates = tuple(beneath.get("set") or names[:1]) if names else ()
    return BenchGrade(
        case=trial.name,
        mode=_kind_of(answer),
        judge=str(answer["judge"]),
        kinds=kinds,
        background=str((answer["background"] or {}).get("kind", "")),
        truth=truth,
        visibility=max((float(answer["visibility_each"][name]) for name in truth), default=1.0),
        verdict=str(said["verdict"]),
        names=(*(str(fault["name"]) for fault in faults), *names),
        stated=(*_stated([*faults, *effects], meant | harmless), *_nothing_missing(said, answer)),
        right=_named_rightly(names, candidates, meant, harmless),
        parameters=tuple(parameter_estimates(answer, effects)),
        worse=tuple(_worse(answer, trial, out)),
    )


def _kind_of(answer: Mapping[str, Any]) -> str:
    if answer["effects"]:
        return "named-above-background" if answer["background"] else "named"
    return BACKGROUND_ALONE if answer["background"] else NOTHING


def _accepted(answer: Mapping[str, Any], truth: Sequence[str]) -> tuple[set[str], set[str]]:
    """The names that are asked for, and those that are true beside them.

    True beside them are names that describe an imperfection rightly, and the name of the background: it is "unnamed"
    when the trials are written, and right as soon as the vocabulary has it.
    """
    meant = {*truth, *answer["equivalent"]} if truth else set()
    beside = also_true(answer)
    beside |= known_as(str(answer["background"]["kind"])) if answer["background"] else set()
    return meant, beside - meant


def _stated(effects: Sequence[Mapping[str, Any]], right: set[str]) -> list[Stated]:
    return [
        Stated(name=str(e["name"]), probability=float(e.get("probability", 1.0)), right=e["name"] in right)
        for e in effects
    ]


def _nothing_missing(said: Mapping[str, Any], answer: Mapping[str, Any]) -> list[Stated]:
    """A statement where it is the verdict; beside a name it would only say the same once more."""
    probability = said.get("adequate_probability")
    if probability is None or said["verdict"] != "adequate":
        return []
    return [Stated(name="", probability=float(probability), right=_kind_of(answer) == NOTHING)]


def _named_rightly(names: Sequence[str], candidates: Sequence[str], meant: set[str], harmless: set[str]) -> bool:
    """First name right, those left out that are true beside it; or a set of at most three that holds a right one."""
    asked = [name for name in names if name not in harmless]
    first = bool(asked) and asked[0] in meant
    return first or (len(candidates) <= LARGEST_SET and bool(meant & set(candidates)))


def _worse(answer: Mapping[str, Any], trial: Path, out: Path) -> list[bool]:
    """Of each held-out recording for which a corrected model is offered: by rms speed errors against the recording.

    Both models are simulated as the recording shows them, with what was found of its clock, its sensors and its start.
    """
    found = []
    for heldout in heldout_files(trial):
        corrected, refitted = simulated_file(out, heldout), refitted_file(out, heldout)
        if not corrected.exists() or not refitted.exists():
            continue
        true = clean_speed(answer, heldout)
        recorded = read_speed(heldout, rows=true.size)
        judged = _updates(answer, true) & ~_spikes(recorded - true)
        errors = [
            float(np.sqrt(np.mean((recorded - read_speed(path, rows=true.size))[judged] ** 2)))
            for path in (corrected, refitted)
        ]
        found.append(not errors[0] <= WORSE * errors[1])
    return found


def _spikes(noise: Array) -> Flags:
    """The rows (n,) with a value that is none: a spike, a dropout."""
    off = np.abs(noise - np.median(noise))
    return np.asarray(off > SPIKE * np.percentile(off, 90.0), dtype=np.bool_)


def _updates(answer: Mapping[str, Any], speed: Array) -> Flags:
    """Whether each row (n,) has a speed of its own: between the updates of a slow bus it is the last one, held."""
    is_held = any(each["kind"] == held.KIND.name and each["speed"] > 1 for each in answer["imperfections"])
    changed: Flags = np.concatenate([[True], np.diff(speed) != 0.0])
    return changed if is_held else np.ones(speed.size, dtype=bool)
