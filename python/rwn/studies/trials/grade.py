"""Marks one diagnosis against the truth."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from rwn.faults.fault import RECORDING
from rwn.studies.trials.adapter import heldout_files, simulated_file
from rwn.studies.trials.damaged import reading, refused
from rwn.studies.trials.effects import known_as
from rwn.studies.trials.plant import simulate
from rwn.studies.trials.run import out_of, trial_folders
from rwn.studies.trials.said import said_in, timing_of
from rwn.studies.trials.seal import ANSWERS, unseal
from rwn.studies.trials.trial_files import read_columns, read_speed

DIAGNOSIS = "diagnosis.json"
NO_RESULT = "no-result"  # the diagnosis failed or was never run
PHASE = "phase"  # of an effect of the angle, known but for whole turns
CONFIDENT = 0.5  # a single name with at least this probability
LARGEST_SET = 3
REMOVABLE = 1.0  # held-out error of the refitted nominal model, in noise units, from which removal counts


@dataclass(frozen=True)
class Estimated:
    """One parameter of a rightly named effect: relative error (phases: rad over pi), interval right."""

    effect: str
    name: str
    error: float
    covered: bool | None


@dataclass(frozen=True)
class Grade:
    """`first` counts a name that reproduces the recordings as well as the true one; `exact` does not."""

    case: str
    mode: str
    visibility: float
    signals: str
    truth: tuple[str, ...]
    equivalent: tuple[str, ...]
    verdict: str
    names: tuple[str, ...]
    candidates: tuple[str, ...]
    probability: float | None
    exact: bool
    first: bool
    in_set: bool
    equation: bool
    ambiguous: bool
    parameters: tuple[Estimated, ...] = ()
    removed: tuple[float, ...] = ()
    seconds: float | None = None
    mistake: str = ""  # in the recordings, and what was said of them
    mistaken: tuple[str, ...] = ()

    @property
    def level(self) -> str:
        """The nearest planned visibility."""
        return str(min((2, 4, 10, 30), key=lambda v: abs(math.log(v / max(self.visibility, 1.0)))))

    @property
    def right(self) -> bool:
        """First name right, or a set of at most three that holds it."""
        return self.first or self.in_set

    @property
    def honest(self) -> bool:
        """Does not claim to know one name: adequate, insufficient excitation, or a set of names."""
        return self.verdict in ("adequate", "insufficient-excitation") or self.ambiguous

    @property
    def false_alarm(self) -> bool:
        return self.mode == "null" and self.verdict not in ("adequate", "insufficient-excitation")

    @property
    def confidently_wrong(self) -> bool:
        """Claims to know one name, which is not right."""
        sure = self.probability is None or self.probability >= CONFIDENT
        single = self.verdict == "missing-physics" and bool(self.names) and not self.ambiguous
        return single and sure and not self.first


@dataclass(frozen=True)
class Graded:
    seeds: tuple[int, ...]  # none where the answers lie open
    split: str | None
    grades: list[Grade]


def load_answers(folder: Path) -> tuple[dict[str, Any], dict[str, dict[str, Any]]]:
    """What is known of the set, and the answers by trial: sealed, or an answer.json in each folder."""
    if (folder / ANSWERS).exists():
        with reading(folder / ANSWERS):
            content = unseal(folder)
            answers: dict[str, dict[str, Any]] = content.pop("answers")
        return content, answers
    found = {}
    for path in sorted(folder.glob("*/answer.json")):
        with reading(path):
            found[path.parent.name] = dict(json.loads(path.read_text()))
    if not found:
        raise ValueError(f"{folder} holds neither {ANSWERS} nor answer.json files")
    return {}, found


def answers_of(trial: Path) -> Path:
    """The file that holds the answer of a trial."""
    sealed = trial.parent / ANSWERS
    return sealed if sealed.exists() else trial / "answer.json"


def grade_folder(folder: Path, *, results: Path | None = None) -> Graded:
    """Opens the seal and grades every trial; one without a diagnosis counts as wrong."""
    about, answers = load_answers(folder)
    grades, trials = [], trial_folders(folder)
    lost = sorted(set(answers) - {trial.name for trial in trials})
    if lost:
        raise refused(folder / lost[0], "the answers hold this trial, and no folder with its model.toml is here")
    for trial in trials:
        if trial.name in answers:
            out = out_of(trial, results)
            with reading(answers_of(trial)):
                grades.append(grade(answers[trial.name], trial, out))
    return Graded((about["seed"],) if "seed" in about else (), about.get("split"), grades)


def grade_folders(folders: Sequence[Path], *, results: Path | None = None) -> Graded:
    """Several sets as one; with more than one, `results` holds a folder for each, of the same name.

    Raises ValueError where development and test sets would be mixed, or one seed counted twice.
    """
    several = len(folders) > 1
    sets = [grade_folder(f, results=results / f.name if results and several else results) for f in folders]
    if len({s.split for s in sets}) > 1:
        raise ValueError("the folders mix development and test sets (or open answers); score each kind alone")
    seeds = tuple(seed for s in sets for seed in s.seeds)
    if len(set(seeds)) < len(seeds):
        raise ValueError(f"two folders hold the same seed (seeds {', '.join(map(str, seeds))}); give each set once")
    grades = [
        replace(g, case=f"{folder.name}/{g.case}") if several else g
        for folder, one in zip(folders, sets, strict=True)
        for g in one.grades
    ]
    return Graded(seeds, sets[0].split, grades)


def grade(answer: Mapping[str, Any], trial: Path, out: Path) -> Grade:
    said: dict[str, Any] = {"verdict": NO_RESULT}
    if os.path.lexists(out / DIAGNOSIS):  # a link that leads nowhere is damage, not a trial without a diagnosis
        said = said_in(out / DIAGNOSIS)
    elif out.exists() and not out.is_dir():
        raise refused(out, "this is no folder")
    mistaken, said = without_mistake(said) if "mistake" in answer else ((), said)
    effects = said.get("effects", []) if said["verdict"] == "missing-physics" else []
    names = tuple(str(effect["name"]) for effect in effects)
    candidates = tuple(said.get("set") or names[:1]) if names else ()
    named = answer["verdict"] == "missing-physics"
    truth = tuple(str(effect["name"]) for effect in answer["effects"])
    equivalent = tuple(answer.get("equivalent", []))
    accepted = {*truth, *equivalent} if named else {name for kind in truth for name in known_as(kind)}
    return Grade(
        case=trial.name,
        mode=str(answer["mode"]),
        visibility=float(answer["visibility"]),
        signals=",".join(answer["signals"]),
        truth=truth,
        equivalent=equivalent,
        verdict=str(said["verdict"]),
        names=names,
        candidates=candidates,
        probability=effects[0].get("probability") if effects else None,
        exact=named and bool(names) and names[0] in truth,
        first=bool(names) and names[0] in accepted,
        in_set=len(candidates) <= LARGEST_SET and any(name in accepted for name in candidates),
        equation=_equation_right(answer, said),
        ambiguous=len(candidates) > 1,
        parameters=tuple(parameter_estimates(answer, effects)) if named else (),
        removed=tuple(_removed(answer, trial, out)),
        seconds=timing_of(out).seconds,
        mistake=str(answer.get("mistake", {}).get("name", "")),
        mistaken=mistaken,
    )


def without_mistake(said: Mapping[str, Any]) -> tuple[tuple[str, ...], dict[str, Any]]:
    """The recording mistakes that were not told apart, likeliest first, and what was said of the drive beneath them."""
    mistakes = [e for e in said.get("effects", []) if e["equation"] == RECORDING]
    physics = [e for e in said.get("effects", []) if e["equation"] != RECORDING]
    if not mistakes:
        return (), dict(said)
    beneath = said["beneath"]
    rest = {**said, "verdict": beneath["verdict"], "effects": physics, "set": beneath["set"]}
    return tuple(said.get("set", ())), rest


def _equation_right(answer: Mapping[str, Any], said: Mapping[str, Any]) -> bool:
    """The first effect's equation, or the located one where nothing has a name."""
    right = {effect["equation"] for effect in answer["effects"]}
    effects = said.get("effects") or [{}]
    return (effects[0].get("equation") or said.get("equation")) in right


def parameter_estimates(answer: Mapping[str, Any], effects: list[dict[str, Any]]) -> list[Estimated]:
    """Parameters of rightly named effects that are stated in the unit of the truth."""
    found = {effect["name"]: effect.get("parameters", {}) for effect in effects}
    out = []
    for effect in answer["effects"]:
        for name, true in effect["parameters"].items():
            said = found.get(effect["name"], {}).get(name)
            if said is None or said["unit"] != true["unit"]:
                continue
            out.append(_estimated(effect["name"], name, float(true["value"]), said))
    return out


def nearest_turn(parameter: str, true: float, said: float) -> float:
    """The true value of a parameter, of an angle the one among its equals that is nearest to what was said."""
    return true + 2.0 * math.pi * round((said - true) / (2.0 * math.pi)) if parameter == PHASE else true


def _estimated(effect: str, name: str, true: float, said: Mapping[str, Any]) -> Estimated:
    near = nearest_turn(name, true, float(said["value"]))
    error = abs(float(said["value"]) - near) / (math.pi if name == PHASE else max(abs(true), 1e-300))
    interval = said.get("interval")
    covered = None if interval is None else bool(interval[0] <= near <= interval[1])
    return Estimated(effect, name, error, covered)


def clean_speed(answer: Mapping[str, Any], heldout: Path) -> np.ndarray[Any, Any]:
    """The held-out speed without noise: from the file where it is given, else from the plant again."""
    kept = heldout.with_name(f"{heldout.stem}_clean.csv")
    if kept.exists():
        return read_speed(kept)
    if "heldout_clean_speed" in answer:
        return np.array(answer["heldout_clean_speed"][heldout_files(heldout.parent).index(heldout)])
    voltage = read_columns(heldout)["voltage"]
    return simulate(answer["plant"], voltage, rate=float(answer["sample_rate_Hz"])).sensed_speed


def _removed(answer: Mapping[str, Any], trial: Path, out: Path) -> list[float]:
    """(refitted - corrected) / (refitted - floor) of each held-out recording where there is error to remove.

    Each is the rms speed error against the recording: model error and noise together. None without such recordings.
    """
    shares: list[float] = []
    sigma, kept_back = float(answer["noise"]["speed_rms"]), heldout_files(trial)
    if not kept_back:
        return shares
    for heldout, effect in zip(kept_back, answer["heldout_effect_in_noise"], strict=True):
        simulated = simulated_file(out, heldout)
        if effect < REMOVABLE or not answer["effects"] or not simulated.exists():
            continue
        clean = clean_speed(answer, heldout)
        error = read_speed(simulated, rows=clean.size) - clean
        refitted = math.hypot(1.0, float(effect))
        corrected = math.hypot(1.0, float(np.sqrt(np.mean(error**2))) / sigma)
        shares.append((refitted - corrected) / (refitted - 1.0))
    return shares
