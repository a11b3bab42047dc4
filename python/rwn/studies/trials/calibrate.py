"""Fits the probability that an effect or a rival acts to trials whose answers are known (rwn.decide.calibration)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from rwn.decide.calibration import FEATURES, Calibration, features
from rwn.report.diagnosis import Diagnosis
from rwn.studies.trials.bench_trials.also_true import also_true
from rwn.studies.trials.damaged import reading
from rwn.studies.trials.effects import known_as
from rwn.studies.trials.grade import load_answers
from rwn.studies.trials.origins import codes, results_of
from rwn.studies.trials.run import out_of, trial_folders

Array = NDArray[np.float64]

RIDGES = (1.0, 3.0, 10.0, 30.0)  # inverse variances of the weights' prior, per standard deviation of a feature
FOLDS = 10  # of the cross-validation; all names of a trial are in one


@dataclass(frozen=True, kw_only=True)
class Names:
    """The effects of the leading explanations: features (n, 5), whether each or a rival acts (n,), its trial (n,)."""

    features: Array
    acts: Array
    trial: NDArray[np.int64]

    @property
    def counted(self) -> str:
        """How many they are, in words."""
        return f"{self.acts.size} names of {np.unique(self.trial).size} trials"


@dataclass(frozen=True, kw_only=True)
class Calibrated:
    """A calibration, and the Brier score of names whose trials it was not fitted to."""

    calibration: Calibration
    names: int
    trials: int
    acting: int
    brier: float
    reliability: tuple[tuple[float, float, int, float], ...]  # from, to, names, share of them that act


def names_of(folders: Sequence[Path], *, results: Path | None = None) -> Names:
    """Every effect of the leading explanations of all trials that have a diagnosis."""
    rows, acts, trials = [], [], []
    for count, (answer, diagnosis) in enumerate(diagnosed(folders, results)):
        true = _true(answer)
        for e in diagnosis.account:
            rows.append(features(e.evidence))
            acts.append(float(bool(true & {e.name, *e.rivals})))
            trials.append(count)
    return Names(features=np.array(rows), acts=np.array(acts), trial=np.array(trials, dtype=np.int64))


def diagnosed(
    folders: Sequence[Path], results: Path | None
) -> Iterator[tuple[Mapping[str, Any], Diagnosis]]:  # fmt: skip
    """The answer and the diagnosis of every trial that has both."""
    for folder in folders:
        _, answers = load_answers(folder)
        own = results_of(folder, folders, results)
        for trial in trial_folders(folder):
            found = out_of(trial, own) / "diagnosis.json"
            if trial.name in answers and found.exists():
                with reading(found):
                    yield answers[trial.name], Diagnosis.from_json(found.read_bytes())


def _true(answer: Mapping[str, Any]) -> set[str]:
    """Every name that says rightly what acts, physics that the trials conceal without a name under the one it has."""
    background = answer.get("background") or {}
    kinds = [e["name"] for e in answer["effects"]] + ([str(background["kind"])] if "kind" in background else [])
    beside = also_true(answer) if "imperfections" in answer else set()
    return set().union(*map(known_as, kinds), answer.get("equivalent", ()), beside)


def calibrated(names: Names, *, what: str) -> Calibrated:
    """The calibration by all names; its reliability, and the prior of its weights, by those of trials left out.

    Raises ValueError where there are too few names to learn from.
    """
    if names.acts.size < 50 or not 5 <= names.acts.sum() <= names.acts.size - 5:
        raise ValueError(f"{names.acts.size} names, {names.acts.sum():.0f} of which act, are too few to calibrate on")
    order = np.random.default_rng(0).permutation(names.trial.max() + 1)
    fold = order[names.trial] % FOLDS
    left_out = {ridge: _left_out(names, fold, ridge) for ridge in RIDGES}
    ridge = max(RIDGES, key=lambda r: float(np.sum(np.log(np.where(names.acts > 0.0, left_out[r], 1.0 - left_out[r])))))
    unseen = left_out[ridge]
    edges = np.array([0.0, 0.05, 0.2, 0.5, 0.8, 0.95, 1.0 + 1e-9])
    bins = [(a, b, (unseen >= a) & (unseen < b)) for a, b in pairwise(edges)]
    return Calibrated(
        calibration=_fitted(names.features, names.acts, what, ridge),
        names=names.acts.size,
        trials=int(np.unique(names.trial).size),
        acting=int(names.acts.sum()),
        brier=float(np.mean((unseen - names.acts) ** 2)),
        reliability=tuple(
            (float(a), float(min(b, 1.0)), int(here.sum()), float(names.acts[here].mean()) if here.any() else np.nan)
            for a, b, here in bins
        ),
    )


def _left_out(names: Names, fold: NDArray[np.int64], ridge: float) -> Array:
    """The probability (n,) of each name by the trials of the other folds."""
    unseen = np.empty(names.acts.size)
    for k in range(FOLDS):
        part = _fitted(names.features[fold != k], names.acts[fold != k], "", ridge)
        unseen[fold == k] = [part.probability_of(f) for f in names.features[fold == k]]
    return unseen


def write(found: Calibration, path: Path) -> None:
    """calibration.json."""
    path.write_bytes(msgspec.json.format(msgspec.json.encode(asdict(found)), indent=1) + b"\n")


def origin(counted: str, folders: Sequence[Path], *, results: Path | None = None) -> str:
    """What was fitted on: how many of what, the sets and the codes that diagnosed them."""
    by = dict.fromkeys(code for f in folders for code in codes(f, results_of(f, folders, results)))
    sets = ", ".join(f.name for f in folders)
    return f"{counted}: {sets}, diagnosed by {' and '.join(by)}"


def _fitted(x: Array, y: Array, what: str, ridge: float) -> Calibration:
    """Logistic regression with a ridge, Newton's method."""
    means, spreads = np.mean(x, axis=0), np.maximum(np.std(x, axis=0), 1e-9)
    z = (x - means) / spreads
    design = np.column_stack([np.ones(len(z)), z])
    penalty = ridge * np.diag([0.0, *np.ones(z.shape[1])])
    weights = np.zeros(design.shape[1])
    for _ in range(100):
        p = 1.0 / (1.0 + np.exp(-np.clip(design @ weights, -40.0, 40.0)))
        slope = design.T @ (y - p) - penalty @ weights
        curvature = (design * (p * (1.0 - p))[:, None]).T @ design + penalty + 1e-9 * np.eye(len(weights))
        step = np.linalg.solve(curvature, slope)
        weights = weights + step * min(1.0, 2.0 / max(float(np.max(np.abs(step))), 1e-300))
        if np.max(np.abs(step)) < 1e-10:
            break
    return Calibration(
        intercept=float(weights[0]), weights=tuple(map(float, weights[1:])), means=tuple(map(float, means)),
        deviations=tuple(map(float, spreads)), fitted_on=what,
    )  # fmt: skip


def words(found: Calibrated) -> str:
    """What was fitted and how good it is, for people."""
    lines = [
        f"{found.names} names of {found.trials} trials, {found.acting} of which act; Brier score of trials left out: "
        f"{found.brier:.3f}",
        *(
            f"  stated {a:.2f} to {b:.2f}: {n} names, {share:.0%} act" if n else f"  stated {a:.2f} to {b:.2f}: none"
            for a, b, n, share in found.reliability
        ),
        "weight per standard deviation of a feature: "
        + ", ".join(f"{n} {w:+.2f}" for n, w in zip(FEATURES, found.calibration.weights, strict=True)),
    ]
    return "\n".join(lines)
