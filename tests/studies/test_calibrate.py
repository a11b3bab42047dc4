"""What a calibration is fitted on, and the misfit factor of intervals that counted with one already."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from made_up import acting
from rwn.decide.account import Remainder
from rwn.decide.calibration import calibration
from rwn.errors import InputError
from rwn.fit.intervals import HALF_WIDTH, Estimate
from rwn.name.found_effect import FoundEffect
from rwn.report.diagnosis import Diagnosis
from rwn.studies.trials.calibrate import (
    Names,
    _misfit_in,
    _misfit_needed,
    calibrated,
    misfit_of,
    names_of,
    origin,
    with_misfit,
)
from rwn.studies.trials.cli import app
from rwn.studies.trials.grade import nearest_turn


@pytest.mark.parametrize("logarithmic", [False, True])
@pytest.mark.parametrize("misfit_factor", [0.0, 2.0, 7.0])
def test_the_misfit_factor_needed_does_not_depend_on_the_one_that_intervals_count_with(
    misfit_factor: float, logarithmic: bool
) -> None:
    """A value that is 12 times its noise off, where three quarters of the error are no noise."""
    left, noise = Remainder(error=4.0, signals=("speed",)), 0.1
    half = HALF_WIDTH * noise * float(np.hypot(1.0, misfit_factor * np.sqrt(0.75)))
    ends = 2.0 * (np.exp([-half, half]) if logarithmic else 1.0 + np.array([-half, half]))
    estimate = Estimate(value=2.0, unit="A", interval=(float(ends[0]), float(ends[1])))
    off = 2.0 * (float(np.exp(12.0 * noise)) if logarithmic else 1.0 + 12.0 * noise)
    needed = _misfit_needed(estimate, off, left, misfit_factor=misfit_factor)
    assert needed == pytest.approx(np.sqrt((12.0 / HALF_WIDTH) ** 2 - 1.0) / np.sqrt(0.75))
    assert _misfit_needed(estimate, 2.1, left, misfit_factor=misfit_factor) == 0.0, "within its noise"
    assert np.isinf(_misfit_needed(estimate, 1e4, Remainder(), misfit_factor=misfit_factor)), "nothing is left"


def test_intervals_of_an_unknown_misfit_factor_are_refused(tmp_path: Path) -> None:
    (tmp_path / "timing.json").write_text('{"seconds": 2.0}')
    with pytest.raises(InputError, match=r"timing\.json: nothing says which misfit factor .*; fix: diagnose the set"):
        _misfit_in(tmp_path)
    (tmp_path / "timing.json").write_text('{"seconds": 2.0, "misfit_factor": 0.4}')
    assert _misfit_in(tmp_path) == 0.4


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
    told = origin(names, [tmp_path / "a", tmp_path / "b"], check=["b"])
    assert told.startswith("3 names of 2 trials: a, b, diagnosed by 1234567 and 89abcde; ")
    assert told.endswith("; misfit factor without b, which check it")


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
            (out / "timing.json").write_text('{"commit": "1234567", "misfit_factor": 0.4}')
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
    found = calibrated(Names(features=x, acts=acts, trial=np.arange(4000) // 2), what="made up", misfit_factor=0.3)
    weights = np.array(found.calibration.weights) / np.array(found.calibration.deviations)
    assert weights[1] == pytest.approx(2.0, rel=0.15)
    assert np.max(np.abs(np.delete(weights, 1))) < 0.2
    assert found.calibration.misfit_factor == 0.3
    assert (found.names, found.trials, found.acting) == (4000, 2000, int(acts.sum()))
    for low, high, count, share in found.reliability:
        if count > 100:
            assert low - 0.05 < share < high + 0.05


def test_the_command_line_fits_says_and_writes_a_calibration(tmp_path: Path) -> None:
    folder, written = _diagnosed(tmp_path / "a", 81), tmp_path / "calibration.json"
    done = CliRunner().invoke(app, ["calibrate", str(folder), "--check", "a", "--out", str(written)])
    assert done.exit_code == 0, done.exception
    assert "160 names of 80 trials, 40 of which act" in done.output
    kept = json.loads(written.read_text())
    assert kept["fitted_on"].endswith("a, diagnosed by 1234567; misfit factor without a, which check it")
    assert kept["misfit_factor"] == 0.0, "no other set says what it should be"
    assert CliRunner().invoke(app, ["calibrate", str(folder)]).output == done.output
    alone = CliRunner().invoke(app, ["calibrate", str(folder), "--misfit-alone", "--out", str(written)])
    assert alone.output.startswith("misfit factor: what is not explained moves a parameter 0.00 times as far")
    assert json.loads(written.read_text())["weights"] == list(calibration().weights)
    wrong = CliRunner().invoke(app, ["calibrate", str(folder), "--check", "b"])
    assert "unknown set 'b'" in str(wrong.exception)


def test_a_phase_is_known_but_for_whole_turns() -> None:
    assert nearest_turn("phase", -3.1, 3.1) == pytest.approx(-3.1 + 2.0 * np.pi)
    assert nearest_turn("phase", 0.2, 0.3) == 0.2
    assert nearest_turn("amplitude", -3.1, 3.1) == -3.1


def test_a_misfit_factor_of_its_own_keeps_the_probabilities() -> None:
    once = with_misfit(1.25, "trials of today")
    again = replace(once, misfit_factor=calibration().misfit_factor, fitted_on=calibration().fitted_on)
    assert again == calibration()
    assert once.misfit_factor == 1.25
    assert once.fitted_on.endswith("; misfit factor by trials of today")


def test_every_trial_counts_alike_in_the_misfit_factor(tmp_path: Path) -> None:
    """One of 20 trials needs 9 for each of its three parameters, the others 1 for their one: 95 % are covered."""
    for k in range(20):
        trial, out = tmp_path / f"trial_{k:04d}", tmp_path / f"trial_{k:04d}" / "out"
        out.mkdir(parents=True)
        (trial / "model.toml").touch()
        names, needed = (("gap", "load_inertia", "load_viscous_share"), 9.0) if k == 0 else (("gap",), 1.0)
        true = {"name": "backlash", "parameters": {name: {"value": 1.1} for name in names}}
        (trial / "answer.json").write_text(json.dumps({"case": trial.name, "effects": [true], "background": {}}))
        half = 0.1 / float(np.hypot(1.0, needed * np.sqrt(0.75)))
        estimate = Estimate(value=1.0, unit="rad", interval=(1.0 - half, 1.0 + half))
        effect = FoundEffect(
            name="backlash", equation="mechanical", probability=0.9, parameters=dict.fromkeys(names, estimate)
        )
        left = Remainder(error=4.0, signals=("speed",))
        (out / "diagnosis.json").write_bytes(
            Diagnosis(verdict="missing-physics", effects=(effect,), remainder=left).to_json()
        )
        (out / "timing.json").write_text('{"commit": "1234567", "misfit_factor": 0.0}')
    assert misfit_of([tmp_path]) == pytest.approx(1.0, rel=1e-3)
