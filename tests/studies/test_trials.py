"""Blind trials from plan to score, with a diagnosis that is made up."""

from __future__ import annotations

import fcntl
import json
import os
import shutil
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rich.console import Console
from typer.testing import CliRunner

import rwn.studies.trials.demo as demo
from rwn.studies.trials import score, tables
from rwn.studies.trials.adapter import heldout_files, simulated_file, train_files
from rwn.studies.trials.aim import UnsuitableError
from rwn.studies.trials.bench import Experiment, Noise, Setup, encoder
from rwn.studies.trials.cli import app
from rwn.studies.trials.conceal import SINGLE
from rwn.studies.trials.dossier import read_columns
from rwn.studies.trials.effects import EFFECTS, NAMED, UNNAMED
from rwn.studies.trials.excitations import CLOSED_LOOP, KINDS, OPEN_LOOP
from rwn.studies.trials.grade import clean_speed, grade_folder, grade_folders, load_answers
from rwn.studies.trials.make import make
from rwn.studies.trials.motors import MOTORS, plant_of
from rwn.studies.trials.plan import SHARES, Plan, plans, redealt
from rwn.studies.trials.plant import simulate
from rwn.studies.trials.run import run
from rwn.studies.trials.scene import draw_scene
from rwn.studies.trials.seal import ANSWERS, SealBrokenError, seal, unseal
from rwn.studies.trials.trial import make_trial, must_move

SEED, COUNT = 179, 6  # one trial of every mode
RESULT = "diagnosis.json"


def tell_the_truth(trial: Path, out: Path) -> None:
    """A diagnosis that has read the answers: every target must be met."""
    answer = load_answers(trial.parent)[1][trial.name]
    effects = [
        {
            "name": effect["name"],
            "equation": effect["equation"],
            "probability": 1.0,
            "parameters": {
                name: p | {"interval": [p["value"] - 1e-9, p["value"] + 1e-9]}
                for name, p in effect["parameters"].items()
            },
        }
        for effect in answer["effects"]
    ]
    named = answer["verdict"] == "missing-physics"
    said = {
        "verdict": answer["verdict"],
        "equation": effects[0]["equation"] if effects else "",
        "effects": effects if named else [],
        "set": [effects[0]["name"]] if named and effects else [],
    }
    for heldout in heldout_files(trial):
        time = read_columns(heldout)["time"]
        table = np.column_stack([time, clean_speed(answer, heldout)])
        np.savetxt(
            simulated_file(out, heldout), table, delimiter=",", header="time [s],speed [rad/s]", comments=""
        )
    (out / RESULT).write_text(json.dumps(said))


def always_backlash(_: Path, out: Path) -> None:
    """A tool that is sure of itself and knows one name."""
    said = {
        "verdict": "missing-physics",
        "equation": "mechanical",
        "effects": [{"name": "backlash", "equation": "mechanical", "probability": 0.9, "parameters": {}}],
        "set": ["backlash"],
    }
    (out / RESULT).write_text(json.dumps(said))


def fails_once(trial: Path, out: Path) -> None:
    mark = trial.parent / f"{trial.name}.tried"
    if not mark.exists():
        mark.touch()
        raise RuntimeError("killed")
    (out / RESULT).write_text('{"verdict": "adequate"}')


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, str]:
    """One set for all workers of pytest-xdist: making it costs more than all tests that read it."""
    base = tmp_path_factory.getbasetemp()
    common = base.parent if "PYTEST_XDIST_WORKER" in os.environ else base
    folder, digest = common / "trials", common / "trials.digest"
    with (common / "trials.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not digest.exists():
            digest.write_text(make(SEED, COUNT, folder, split="development", jobs=2))
    return folder, digest.read_text()


def test_rivals_are_effects() -> None:
    assert {rival for effect in EFFECTS.values() for rival in effect.rivals} <= set(EFFECTS)


def test_there_are_unnamed_kinds_enough() -> None:
    assert len(UNNAMED) >= 6
    assert not set(UNNAMED) & set(NAMED)


def test_plans_cover_modes_and_effects_evenly() -> None:
    planned = plans(5, 300)
    for mode, share in SHARES.items():
        assert abs(sum(p.mode == mode for p in planned) - 300 * share) <= 1
    counts = [sum(p.effects == (name,) for p in planned if p.mode in SINGLE) for name in NAMED]
    assert max(counts) - min(counts) <= 1
    assert planned == plans(5, 300)
    assert planned != plans(6, 300)


@pytest.mark.slow
def test_a_trial_is_the_same_every_time() -> None:
    plan = Plan(1, 0, "offset", ("coulomb-friction",), 10.0)
    first, again = make_trial(plan), make_trial(plan)
    assert first.answer == again.answer
    np.testing.assert_array_equal(first.train[0].speed, again.train[0].speed)
    assert first.answer["visibility"] == pytest.approx(10.0, rel=0.08)
    assert first.nominal.values != first.answer["true_parameters"]


def test_recording_is_the_plant_and_its_noise() -> None:
    trial = make_trial(Plan(3, 1, "null", (), 1.0))
    noise, recording = trial.answer["noise"], trial.train[0]
    clean = simulate(trial.answer["plant"], recording.voltage, rate=trial.answer["sample_rate_Hz"])
    rms = float(np.sqrt(np.mean((recording.speed - clean.sensed_speed) ** 2)))
    assert rms == pytest.approx(noise["speed_rms"], rel=0.2)


@pytest.mark.slow
def test_masked_nominal_hides_the_effect() -> None:
    """The nominal model as given fits the training recordings about as well as its refit."""
    trial = make_trial(Plan(3, 2, "masked", ("quadratic-drag",), 10.0))
    errors = []
    for nominal in (trial.nominal.values, trial.answer["true_parameters"]):
        squares = [
            np.mean(
                (simulate(plant_of(nominal), r.voltage, rate=trial.answer["sample_rate_Hz"]).speed - r.speed)
                ** 2
            )
            for r in trial.train
        ]
        errors.append(np.sqrt(np.mean(squares)))
    assert errors[0] < 0.8 * errors[1]


@pytest.mark.slow
def test_folder_holds_recordings_and_no_answer(made: tuple[Path, str]) -> None:
    folder, _ = made
    trials = sorted(path for path in folder.iterdir() if path.is_dir())
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
    with pytest.raises(SealBrokenError, match="SHA-256"):
        unseal(tmp_path)


@pytest.mark.slow
def test_finished_set_is_not_made_again(made: tuple[Path, str]) -> None:
    with pytest.raises(FileExistsError):
        make(SEED, COUNT, made[0])


def test_seed_must_agree_with_the_split(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="development split"):
        make(7, 1, tmp_path, split="test")
    with pytest.raises(ValueError, match="test split"):
        make(10_000, 1, tmp_path, split="development")


@pytest.mark.slow
def test_truthful_tool_meets_every_target(made: tuple[Path, str], tmp_path: Path) -> None:
    assert run(made[0], results=tmp_path, jobs=1, diagnose=tell_the_truth) == []
    graded = grade_folder(made[0], results=tmp_path)
    assert graded.split == "development"
    assert all(target.met in (True, None) for target in score.targets(graded.grades))
    named = [g for g in graded.grades if g.mode in SINGLE]
    assert named
    assert all(g.exact and g.first and g.equation for g in named)
    assert all(p.error == 0.0 and p.covered for g in named for p in g.parameters)
    assert all(share == pytest.approx(1.0, abs=1e-3) for g in named for share in g.removed)


@pytest.mark.slow
def test_confident_wrong_tool_is_found_out(made: tuple[Path, str], tmp_path: Path) -> None:
    run(made[0], results=tmp_path, jobs=1, diagnose=always_backlash)
    grades = grade_folder(made[0], results=tmp_path).grades
    assert not any(g.exact for g in grades if "backlash" not in g.truth)
    assert all(g.false_alarm for g in grades if g.mode == "null")
    assert all(g.confidently_wrong for g in grades if g.mode == "novel")
    brier, count = score.brier(grades)
    assert count == COUNT
    assert brier == pytest.approx(0.81) or any("backlash" in g.truth + g.equivalent for g in grades)
    console = Console(record=True, width=200, file=None, quiet=False)
    tables.show(grade_folder(made[0], results=tmp_path), console)
    text = console.export_text()
    assert "misses" in text
    assert "not evidence" in text
    tables.reliability_plot(score.reliability(grades), tmp_path / "plot.html")
    assert "calibrated" in (tmp_path / "plot.html").read_text()


@pytest.mark.slow
def test_several_sets_count_as_one(made: tuple[Path, str], shared: Path, tmp_path: Path) -> None:
    shutil.copytree(made[0], tmp_path / "copy")
    run(shared / "cases", results=tmp_path / "results" / "cases", jobs=1, diagnose=tell_the_truth)
    with pytest.raises(ValueError, match="mix"):
        grade_folders([made[0], shared / "cases"], results=tmp_path / "results")
    with pytest.raises(ValueError, match="same seed"):
        grade_folders([made[0], tmp_path / "copy"])
    shutil.copytree(shared / "cases", tmp_path / "again")
    run(tmp_path / "again", results=tmp_path / "results" / "again", jobs=1, diagnose=always_backlash)
    both = grade_folders([shared / "cases", tmp_path / "again"], results=tmp_path / "results")
    assert len(both.grades) == 28
    assert {g.case for g in both.grades if g.exact} >= {"cases/case_01"}
    assert len({g.case for g in both.grades}) == 28


@pytest.mark.slow
def test_trial_without_a_diagnosis_counts_as_wrong(made: tuple[Path, str], tmp_path: Path) -> None:
    grades = grade_folder(made[0], results=tmp_path).grades
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
def test_command_line_scores_and_explains_itself(made: tuple[Path, str], tmp_path: Path) -> None:
    run(made[0], results=tmp_path, jobs=1, diagnose=tell_the_truth)
    done = CliRunner().invoke(app, ["score", str(made[0]), "--results", str(tmp_path)])
    assert done.exit_code == 0
    assert "targets" in done.output
    wrong = CliRunner().invoke(
        app, ["make", "--seed", "3", "--count", "1", "--out", str(tmp_path / "x"), "--split", "test"]
    )
    assert "development split" in str(wrong.exception)


@pytest.mark.slow
def test_example_cases_can_be_scored(shared: Path, tmp_path: Path) -> None:
    run(shared / "cases", results=tmp_path, jobs=1, diagnose=tell_the_truth)
    grades = grade_folder(shared / "cases", results=tmp_path).grades
    assert len(grades) == 14
    assert all(g.exact for g in grades if g.mode in (*SINGLE, "double"))
    assert not any(g.false_alarm or g.confidently_wrong for g in grades if g.mode in ("null", "novel"))


@pytest.mark.parametrize("kind", KINDS)
def test_excitation_has_peak_one_and_moves(kind: str) -> None:
    shape = (OPEN_LOOP | CLOSED_LOOP)[kind](np.random.default_rng(1), 3000, 40.0)
    assert shape.shape == (3000,)
    assert np.max(np.abs(shape)) == pytest.approx(1.0)
    assert np.std(shape) > 0.1


@pytest.mark.parametrize("motor", MOTORS, ids=lambda motor: motor.name)
def test_speed_loop_settles_on_its_reference(motor: Any) -> None:
    rate = 2000.0
    setup = Setup(motor, rate, ("V", "w"))
    experiment = Experiment("cl_steps", int(100 * motor.time_constant * rate), 0.5 * motor.voltage, (1, 2))
    trace = setup.run(experiment, plant_of(motor.nominal(dry=True)))
    wanted = setup.shape(experiment) * 0.4 * motor.voltage / motor.torque_constant
    closed = motor.torque_constant * motor.time_constant / setup.loop[0]  # s
    changes = np.flatnonzero(np.diff(wanted))
    ends = changes[1:][np.diff(changes) > 4.5 * closed * rate]
    assert ends.size > 2
    off = np.abs(trace.speed[ends] - wanted[ends]) / np.max(np.abs(wanted))
    assert np.median(off) < 0.01
    assert np.max(off) < 0.1  # after a large step, on which the voltage is at its ceiling for long
    assert np.max(np.abs(trace.voltage)) <= 1.15 * experiment.amplitude * (1 + 1e-6)


def test_encoder_speed_has_the_declared_error() -> None:
    rng = np.random.default_rng(2)
    speed = 80.0 + 30.0 * np.cumsum(rng.standard_normal(20_000)) / 100.0
    position = np.cumsum(speed) / 1000.0
    _, seen = encoder(position, 2048, 1000.0)
    exact = np.gradient(position) * 1000.0
    rms = float(np.sqrt(np.mean((seen - exact)[1:-1] ** 2)))
    assert rms == pytest.approx(Noise.of_encoder(2048, 1000.0, 0.0).speed, rel=0.05)


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


def test_effects_that_no_bench_shows_are_dealt_again() -> None:
    for plan in plans(5, 60):
        other = redealt(plan, 12)
        assert other == redealt(plan, 12)
        assert (other.mode, other.visibility, other.name) == (plan.mode, plan.visibility, plan.name)
        assert len(other.effects) == len(plan.effects)
        assert (other.effects != plan.effects) == bool(plan.effects)


def test_a_machine_that_cannot_be_is_drawn_again() -> None:
    """Two effects may leave no inertia on the motor side (trial 45 of seed 10013)."""
    scene, _ = draw_scene(np.random.default_rng(1), (0, 1, 1), [])
    nothing_left = scene.plant([]) | {"load_inertia": 2.0 * scene.true["inertia"]}
    with pytest.raises(UnsuitableError, match="no such machine"):
        scene.run(scene.train, nothing_left)


def test_held_out_runs_move() -> None:
    """One of trial 22 of seed 10014 stood still in its dry friction."""
    scene, _ = draw_scene(np.random.default_rng(1), (0, 1, 1), [])
    moving = scene.run(scene.heldout, scene.plant([]))
    must_move(moving)
    stuck = scene.run(scene.heldout, scene.plant([]) | {"coulomb_plus": 1e3, "coulomb_minus": 1e3})
    with pytest.raises(UnsuitableError, match="never moves"):
        must_move([*moving, *stuck])
