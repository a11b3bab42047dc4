"""What a calibration is fitted on."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from made_up import acting
from rwn.report.diagnosis import Diagnosis
from rwn.studies.trials.calibrate import Names, calibrated, names_of, origin
from rwn.studies.trials.cli import app


def test_a_calibration_says_what_it_was_fitted_on(tmp_path: Path) -> None:
    for name, commit in (("a", "1234567"), ("b", "89abcde")):
        for trial, done in (("trial_0001", True), ("trial_0002", False)):
            out = tmp_path / name / trial / "out"
            out.mkdir(parents=True)
            (out.parent / "model.toml").touch()
            if done:
                (out / "diagnosis.json").touch()
                (out / "timing.json").write_text(json.dumps({"commit": commit, "date": "", "machine": ""}))
    names = Names(features=np.zeros((3, 5)), acts=np.ones(3), trial=np.array([0, 0, 1]))
    told = origin(names.counted, [tmp_path / "a", tmp_path / "b"])
    assert told == "3 names of 2 trials: a, b, diagnosed by 1234567 and 89abcde"


def _diagnosed(folder: Path, count: int) -> Path:
    """Trials with open answers: what removes most of the mismatch acts, but one of ten that does is a mimic."""
    rng = np.random.default_rng(5)
    for k in range(count):
        trial, out = folder / f"trial_{k:04d}", folder / f"trial_{k:04d}" / "out"
        out.mkdir(parents=True)
        (trial / "model.toml").touch()
        acts = k % 2 == 0
        share = float(rng.uniform(0.5, 0.99) if acts != (k % 10 == 0) else rng.uniform(0.01, 0.4))
        answer = {"case": trial.name, "effects": [{"name": "backlash"}] if acts else [], "background": {}}
        (trial / "answer.json").write_text(json.dumps(answer))
        if k:  # the first has no diagnosis yet
            account = (acting("backlash", 0.5, share), acting("unbalance", 0.1, 0.02))
            found = Diagnosis(verdict="adequate", account=account)
            (out / "diagnosis.json").write_bytes(found.to_json())
            (out / "timing.json").write_text('{"commit": "1234567"}')
    return folder


def test_the_names_of_every_diagnosis_are_judged_by_the_answers(tmp_path: Path) -> None:
    names = names_of([_diagnosed(tmp_path / "a", 41)])
    assert names.features.shape == (80, 5)  # of 40 diagnosed trials two names each
    assert np.unique(names.trial).size == 40
    assert names.acts.sum() == 20.0
    assert not names.acts[1::2].any(), "the other name of each trial acts in none"


def test_too_few_names_make_no_calibration() -> None:
    for count, acting_ones in ((49, 20), (60, 4), (60, 56)):
        names = Names(
            features=np.zeros((count, 5)), acts=np.array([float(k < acting_ones) for k in range(count)]),
            trial=np.arange(count),
        )  # fmt: skip
        with pytest.raises(ValueError, match=f"{count} names, {acting_ones} of which act, are too few"):
            calibrated(names, what="")


def test_a_calibration_finds_the_law_that_its_names_follow() -> None:
    """Names that act with the probability of a logistic law of one feature, and no other."""
    rng = np.random.default_rng(3)
    x = rng.standard_normal((4000, 5))
    acts = (rng.random(4000) < 1.0 / (1.0 + np.exp(-(0.5 + 2.0 * x[:, 1])))).astype(float)
    found = calibrated(Names(features=x, acts=acts, trial=np.arange(4000) // 2), what="made up")
    weights = np.array(found.calibration.weights) / np.array(found.calibration.deviations)
    assert weights[1] == pytest.approx(2.0, rel=0.15)
    assert np.max(np.abs(np.delete(weights, 1))) < 0.2
    assert (found.names, found.trials, found.acting) == (4000, 2000, int(acts.sum()))
    for low, high, count, share in found.reliability:
        if count > 100:
            assert low - 0.05 < share < high + 0.05


def test_the_command_line_fits_says_and_writes_a_calibration(tmp_path: Path) -> None:
    folder, written = _diagnosed(tmp_path / "a", 81), tmp_path / "calibration.json"
    done = CliRunner().invoke(app, ["calibrate", str(folder), "--out", str(written)])
    assert done.exit_code == 0, done.exception
    assert "160 names of 80 trials, 40 of which act" in done.output
    kept = json.loads(written.read_text())
    assert kept["fitted_on"].endswith("a, diagnosed by 1234567")
    assert CliRunner().invoke(app, ["calibrate", str(folder)]).output == done.output
