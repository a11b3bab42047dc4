"""Blind trials from plan to score, with a diagnosis that is made up."""

from __future__ import annotations

import fcntl
import json
import os
import shutil
import tomllib
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from rich.console import Console
from typer.testing import CliRunner

import rwn.studies.trials.demo as demo
from made_up_tools import RESULT, always_backlash, fails_once, tell_the_truth
from rwn.studies.trials import score, tables
from rwn.studies.trials.adapter import heldout_files, train_files
from rwn.studies.trials.cli import app
from rwn.studies.trials.conceal import SINGLE
from rwn.studies.trials.grade import grade_folder, grade_folders, load_answers
from rwn.studies.trials.make import make
from rwn.studies.trials.motors import plant_of
from rwn.studies.trials.plan import plans
from rwn.studies.trials.plant import simulate
from rwn.studies.trials.run import run
from rwn.studies.trials.seal import ANSWERS, SealBrokenError, seal, unseal
from rwn.studies.trials.trial import make_trial
from rwn.studies.trials.trial_files import read_columns, write_trial

SEED, COUNT = 661, 6  # one trial of every mode, of those that are soon made


def _once(factory: pytest.TempPathFactory, name: str, make_it: Callable[[Path], object]) -> Path:
    """A folder that is made once for all workers of pytest-xdist."""
    base = factory.getbasetemp()
    common = base.parent if "PYTEST_XDIST_WORKER" in os.environ else base
    folder, done = common / name, common / f"{name}.done"
    with (common / f"{name}.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not done.exists():
            make_it(folder)
            done.touch()
    return folder


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A set of trials."""
    return _once(tmp_path_factory, "trials", lambda folder: make(SEED, COUNT, folder, split="development", jobs=2))


@pytest.fixture(scope="module")
def told(made: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What a tool says of them that knows the answers."""

    def tell(out: Path) -> None:
        assert run(made, results=out, jobs=1, diagnose=tell_the_truth) == []

    return _once(tmp_path_factory, "told", tell)


@pytest.fixture(scope="module")
def cases_told(shared: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What it says of the example cases."""
    tell = partial(run, shared / "cases", jobs=1, diagnose=tell_the_truth)
    return _once(tmp_path_factory, "cases_told", lambda out: tell(results=out))


@pytest.mark.slow
def test_a_trial_is_the_same_every_time(made: Path, tmp_path: Path) -> None:
    """Made again, in another process: one of two effects, and one of a nominal model that is off."""
    answers = load_answers(made)[1]
    again = {plan.name: make_trial(plan) for plan in plans(SEED, COUNT) if plan.mode in ("double", "offset")}
    assert len(again) == 2
    for name, trial in again.items():
        assert json.loads(json.dumps(trial.answer)) == answers[name]
        assert trial.nominal.values != trial.answer["true_parameters"]
        write_trial(tmp_path / name, trial)
        files = sorted(path.name for path in (made / name).iterdir())
        assert files == sorted(path.name for path in (tmp_path / name).iterdir())
        for file in files:
            assert (tmp_path / name / file).read_bytes() == (made / name / file).read_bytes()


@pytest.mark.slow
def test_single_effects_are_as_visible_as_planned(made: Path) -> None:
    answers = load_answers(made)[1]
    planned = [plan for plan in plans(SEED, COUNT) if plan.mode in ("masked", "novel", "offset")]
    assert len(planned) == 3
    for plan in planned:
        assert answers[plan.name]["visibility"] == pytest.approx(plan.visibility, rel=0.08)


@pytest.mark.slow
def test_masked_nominal_hides_the_effect(made: Path) -> None:
    """The nominal model as given fits the training recordings about as well as its refit."""
    answers = load_answers(made)[1]
    (answer,) = (answer for answer in answers.values() if answer["mode"] == "masked")
    folder = made / answer["case"]
    given = {k: v for k, v in tomllib.loads((folder / "model.toml").read_text())["motor"].items() if k != "kind"}
    recordings = [read_columns(path) for path in train_files(folder)]

    def error(nominal: dict[str, float]) -> float:
        plant, rate = plant_of(nominal), answer["sample_rate_Hz"]
        squares = [np.mean((simulate(plant, r["voltage"], rate=rate).speed - r["speed"]) ** 2) for r in recordings]
        return float(np.sqrt(np.mean(squares)))

    assert error(given) < 0.8 * error(answer["true_parameters"])


@pytest.mark.slow
def test_folder_holds_recordings_and_no_answer(made: Path) -> None:
    trials = sorted(path for path in made.iterdir() if path.is_dir())
    assert len(trials) == COUNT
    for trial in trials:
        assert train_files(trial)
        assert len(heldout_files(trial)) == 2
        names = {path.name.split("_")[0].split(".")[0] for path in trial.iterdir()}
        assert names == {"model", "train", "heldout"}
        model = tomllib.loads((trial / "model.toml").read_text())
        assert set(model["uncertainty"]) <= set(model["motor"])
        columns = read_columns(train_files(trial)[0])
        assert list(columns)[:2] == ["time", "voltage"]
        assert np.all(np.isfinite(np.column_stack(list(columns.values()))))


def test_seal_breaks_when_the_answers_change(tmp_path: Path) -> None:
    digest = seal(tmp_path, {"answers": {"a": 1}})
    assert digest in (tmp_path / "answers.sha256").read_text()
    assert unseal(tmp_path) == {"answers": {"a": 1}}
    packed = bytearray((tmp_path / ANSWERS).read_bytes())
    packed[-1] ^= 1
    (tmp_path / ANSWERS).write_bytes(bytes(packed))
    with pytest.raises(SealBrokenError, match=r"answers\.sealed: the SHA-256 is .*; expected .*; fix: "):
        unseal(tmp_path)


@pytest.mark.slow
def test_finished_set_is_not_made_again(made: Path) -> None:
    with pytest.raises(FileExistsError):
        make(SEED, COUNT, made)


def test_seed_must_agree_with_the_split(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="development split"):
        make(7, 1, tmp_path, split="test")
    with pytest.raises(ValueError, match="test split"):
        make(10_000, 1, tmp_path, split="development")


@pytest.mark.slow
def test_truthful_tool_meets_every_target(made: Path, told: Path) -> None:
    graded = grade_folder(made, results=told)
    assert graded.split == "development"
    assert all(target.met in (True, None) for target in score.targets(graded.grades))
    named = [g for g in graded.grades if g.mode in SINGLE]
    assert named
    assert all(g.exact and g.first and g.equation for g in named)
    assert all(p.error == 0.0 and p.covered for g in named for p in g.parameters)
    assert all(share == pytest.approx(1.0, abs=1e-3) for g in named for share in g.removed)


@pytest.mark.slow
def test_confident_wrong_tool_is_found_out(made: Path, tmp_path: Path) -> None:
    run(made, results=tmp_path, jobs=1, diagnose=always_backlash)
    grades = grade_folder(made, results=tmp_path).grades
    assert not any(g.exact for g in grades if "backlash" not in g.truth)
    assert all(g.false_alarm for g in grades if g.mode == "null")
    assert all(g.confidently_wrong for g in grades if g.mode == "novel")
    brier, count = score.brier(grades)
    assert count == COUNT
    assert brier == pytest.approx(0.81) or any("backlash" in g.truth + g.equivalent for g in grades)
    console = Console(record=True, width=200, file=None, quiet=False)
    for part in tables.shown(grade_folder(made, results=tmp_path)):
        console.print(part)
    text = console.export_text()
    assert "misses" in text
    assert "not evidence" in text
    tables.reliability_plot(score.reliability(grades), tmp_path / "plot.html")
    assert "calibrated" in (tmp_path / "plot.html").read_text()


@pytest.mark.slow
def test_several_sets_count_as_one(made: Path, shared: Path, cases_told: Path, tmp_path: Path) -> None:
    shutil.copytree(made, tmp_path / "copy")
    shutil.copytree(cases_told, tmp_path / "results" / "cases")
    with pytest.raises(ValueError, match="mix"):
        grade_folders([made, shared / "cases"], results=tmp_path / "results")
    with pytest.raises(ValueError, match="same seed"):
        grade_folders([made, tmp_path / "copy"])
    shutil.copytree(shared / "cases", tmp_path / "again")
    run(tmp_path / "again", results=tmp_path / "results" / "again", jobs=1, diagnose=always_backlash)
    both = grade_folders([shared / "cases", tmp_path / "again"], results=tmp_path / "results")
    assert len(both.grades) == 28
    assert {g.case for g in both.grades if g.exact} >= {"cases/case_01"}
    assert len({g.case for g in both.grades}) == 28


@pytest.mark.slow
def test_trial_without_a_diagnosis_counts_as_wrong(made: Path, tmp_path: Path) -> None:
    grades = grade_folder(made, results=tmp_path).grades
    assert len(grades) == COUNT
    assert not any(g.right or g.honest or g.equation for g in grades)
    assert all(g.false_alarm for g in grades if g.mode == "null")


@pytest.mark.slow
def test_run_goes_on_where_it_was_stopped(tmp_path: Path) -> None:
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "model.toml").touch()
    assert run(tmp_path, jobs=1, diagnose=fails_once) == ["a", "b"]
    assert "killed" in (tmp_path / "a" / "out" / "error.txt").read_text()
    seen: list[str] = []
    (tmp_path / "b" / "out" / RESULT).write_text("{}")
    assert run(tmp_path, jobs=1, diagnose=fails_once, progress=lambda *x: seen.append(x[2])) == []
    assert seen == ["a"]
    assert not (tmp_path / "a" / "out" / "error.txt").exists()


def test_folder_without_trials_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="no trials"):
        run(tmp_path)


@pytest.mark.slow
def test_command_line_scores_and_explains_itself(made: Path, told: Path, tmp_path: Path) -> None:
    done = CliRunner().invoke(app, ["score", str(made), "--results", str(told)])
    assert done.exit_code == 0
    assert "targets" in done.output
    page = tmp_path / "page.md"
    page.write_text("above\n<!-- rwn trials score trials -->\nold\n<!-- end -->\nbelow\n")
    line = ["score", str(made), "--results", str(told), "--page", str(page)]
    assert CliRunner().invoke(app, line).exit_code == 0
    text = page.read_text()
    assert text.startswith("above\n<!-- rwn trials score trials -->\n6 trials, seed 661, development split")
    assert "targets:\n\n| figure | asked | found | met |\n|---|---|---|---|\n| " in text
    assert (made / "answers.sha256").read_text().split()[0] in text
    assert "old" not in text
    assert text.endswith("<!-- end -->\nbelow\n")
    other = CliRunner().invoke(app, ["score", str(told), "--page", str(page)])
    assert "there is no section for 'told'" in str(other.exception)
    wrong = CliRunner().invoke(
        app, ["make", "--seed", "3", "--count", "1", "--out", str(tmp_path / "x"), "--split", "test"]
    )
    assert "development split" in str(wrong.exception)


@pytest.mark.slow
def test_example_cases_can_be_scored(shared: Path, cases_told: Path) -> None:
    grades = grade_folder(shared / "cases", results=cases_told).grades
    assert len(grades) == 14
    assert all(g.exact for g in grades if g.mode in (*SINGLE, "double"))
    assert not any(g.false_alarm or g.confidently_wrong for g in grades if g.mode in ("null", "novel"))


def test_a_case_without_recordings_kept_back_is_scored_by_what_it_names(shared: Path, tmp_path: Path) -> None:
    folder = tmp_path / "set"
    for name in ("train_1.csv", "model.toml", "answer.json"):
        (folder / "case_01").mkdir(parents=True, exist_ok=True)
        shutil.copy(shared / "messy" / "outliers" / "case_01" / name, folder / "case_01" / name)
    assert run(folder, results=tmp_path / "told", jobs=1, diagnose=tell_the_truth) == []
    (grade,) = grade_folder(folder, results=tmp_path / "told").grades
    assert grade.exact
    assert grade.removed == ()


def test_demonstration_recordings_can_be_made_again(tmp_path: Path) -> None:
    """Numbers may differ in the last digit between machines, nothing else."""
    demo.write_demo(tmp_path)
    kept = Path(demo.__file__).parents[2] / "demo"
    assert {path.name for path in tmp_path.iterdir()} == {"model.toml", "train.csv", "heldout.csv"}
    assert (tmp_path / "model.toml").read_text() == (kept / "model.toml").read_text()
    assert sum(path.stat().st_size for path in kept.iterdir()) < 400_000
    for name in ("train.csv", "heldout.csv"):
        fresh, old = read_columns(tmp_path / name), read_columns(kept / name)
        assert list(fresh) == list(old)
        for signal, values in fresh.items():
            np.testing.assert_allclose(values, old[signal], rtol=2e-5, atol=1e-6)
