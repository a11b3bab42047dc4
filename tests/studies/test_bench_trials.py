"""Bench trials: what is planned, made, and scored."""

from __future__ import annotations

import json
import shutil
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rich.console import Console
from typer.testing import CliRunner

from rwn.studies.trials.bench_trials import score, tables
from rwn.studies.trials.bench_trials.also_true import also_true
from rwn.studies.trials.bench_trials.grade import BenchGraded, grade, grade_folders, is_bench
from rwn.studies.trials.bench_trials.plan import (
    BACKGROUND_ALONE,
    MODES,
    NAMED_ABOVE,
    NOTHING,
    TEST_ONLY,
    BenchPlan,
    beneath,
    plans,
    redealt,
    together,
)
from rwn.studies.trials.bench_trials.trial import make_bench_trial
from rwn.studies.trials.cli import app
from rwn.studies.trials.effects import BACKGROUND, NAMED
from rwn.studies.trials.grade import clean_speed
from rwn.studies.trials.judges import JUDGES
from rwn.studies.trials.make import make_bench
from rwn.studies.trials.seal import unseal
from rwn.studies.trials.trial import Trial
from rwn.studies.trials.trial_files import read_columns, write_trial

SEED = 224  # of a first trial that is soon made
PLAN = BenchPlan(seed=3, index=2, mode=NAMED_ABOVE, effects=("quadratic-drag",), visibilities=(10.0,),
                 background="square-root-drag", background_visibility=3.0, nominal="offset")  # fmt: skip
SOON_MADE = replace(PLAN, effects=("sensor-quantization",))  # the same bench; no strength is searched for


@pytest.fixture(scope="module")
def trial() -> Trial:
    return make_bench_trial(PLAN)


def test_plans_spread_modes_numbers_and_judges() -> None:
    planned = plans(5, 200)
    for mode, share in MODES.items():
        assert abs(sum(p.mode == mode for p in planned) - 200 * share) <= 1
    assert {len(p.effects) for p in planned if p.mode not in (NOTHING, BACKGROUND_ALONE)} == {1, 2, 3}
    assert abs(sum(p.judge == "mujoco" for p in planned) - 200 / 3) <= 1
    assert sum(bool(p.background) for p in planned) == 100
    assert planned == plans(5, 200) != plans(6, 200)
    assert {p.judge for p in plans(5, 20, judge="plant")} == {"plant"}


def test_plans_hold_what_a_judge_knows_and_what_goes_together() -> None:
    for plan in (*plans(5, 200), *(redealt(p, 12) for p in plans(5, 40))):
        assert together(plan.effects)
        assert set(plan.effects) <= set(NAMED)
        assert all(JUDGES[plan.judge].knows(name) for name in plan.effects)
        if plan.background:
            assert plan.background in BACKGROUND
            assert plan.background not in NAMED
            assert beneath(plan.background, plan.effects)
        assert len(plan.visibilities) == len(plan.effects)


def test_some_backgrounds_are_kept_for_tests() -> None:
    assert not {p.background for p in plans(5, 300)} & TEST_ONLY
    assert {p.background for p in plans(10_005, 300)} & TEST_ONLY


@pytest.mark.slow
def test_a_bench_trial_is_the_same_every_time(tmp_path: Path) -> None:
    first, again = make_bench_trial(SOON_MADE), make_bench_trial(SOON_MADE)
    assert first.answer["background"]
    assert first.answer["imperfections"]
    for name, one in (("a", first), ("b", again)):
        write_trial(tmp_path / name, one)
    files = sorted(path.name for path in (tmp_path / "a").iterdir())
    assert files == sorted(path.name for path in (tmp_path / "b").iterdir())
    for name in files:
        assert (tmp_path / "a" / name).read_bytes() == (tmp_path / "b" / name).read_bytes()
    assert json.dumps(first.answer) == json.dumps(again.answer)


@pytest.mark.slow
def test_answers_hold_what_acts_and_folders_do_not(trial: Trial, tmp_path: Path) -> None:
    answer = trial.answer
    assert [effect["name"] for effect in answer["effects"]] == ["quadratic-drag"]
    assert answer["visibility_each"]["quadratic-drag"] == pytest.approx(10.0, rel=0.3)
    assert answer["background"]["visibility"] == pytest.approx(3.0, rel=0.3)
    assert 1 <= len(answer["imperfections"]) <= 3
    write_trial(tmp_path / "t", trial)
    names = {path.name.split("_")[0].split(".")[0] for path in (tmp_path / "t").iterdir()}
    assert names == {"model", "task", "train", "heldout"}
    assert set(json.loads((tmp_path / "t" / "task.json").read_text())) <= {"heldout", "gain_uncertainty"}
    text = "".join(path.read_text() for path in (tmp_path / "t").iterdir())
    said = ["quadratic-drag", "square-root-drag", *(each["kind"] for each in answer["imperfections"])]
    assert not any(word in text for word in said)
    for recording in (*trial.train, *trial.heldout):
        assert recording.time.size <= 6000
        assert np.all(np.diff(recording.time) > 0.0)


@pytest.mark.slow
def test_clean_speeds_fit_the_rows_of_the_files(trial: Trial, tmp_path: Path) -> None:
    write_trial(tmp_path / "t", trial)
    sigma = trial.answer["noise"]["recorded_speed_rms"]
    for path in sorted((tmp_path / "t").glob("heldout_*.csv")):
        off = read_columns(path)["speed"] - clean_speed(trial.answer, path)
        assert float(np.median(np.abs(off))) < 2.0 * sigma


@pytest.mark.slow
def test_a_set_is_sealed_and_its_kind_is_known(tmp_path: Path) -> None:
    make_bench(SEED, 1, tmp_path / "one", judge="plant", jobs=1)
    shutil.copytree(tmp_path / "one", tmp_path / "two")
    assert unseal(tmp_path / "one")["bench"] is True
    assert is_bench(tmp_path / "one")
    done = CliRunner().invoke(app, ["score", str(tmp_path / "one")])
    assert done.exit_code == 0
    assert "WITHOUT A DIAGNOSIS" in done.output
    with pytest.raises(ValueError, match="same seed"):
        grade_folders([tmp_path / "one", tmp_path / "two"])


def test_a_judge_that_is_missing_is_said_in_one_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("rwn.studies.trials.judges.mujoco.find_spec", lambda _: None)
    with pytest.raises(ValueError, match=r"pip install 'rwn\[judges\]'.*--judge plant"):
        make_bench(3, 1, tmp_path / "x")
    done = CliRunner().invoke(app, ["make", "--bench", "--seed", "3", "--count", "1", "--out", str(tmp_path / "y")])
    assert "pip install" in str(done.exception)
    with pytest.raises(ValueError, match="must be one of"):
        make_bench(3, 1, tmp_path / "z", judge="nobody")


# Scoring, on answers and diagnoses made by hand.


def the_answer(**changes: Any) -> dict[str, Any]:
    effect = {
        "name": "quadratic-drag", "equation": "mechanical",
        "parameters": {"drag_coefficient": {"value": 2.0, "unit": "N m s^2/rad^2"}},
    }  # fmt: skip
    base = {
        "effects": [effect], "equivalent": ["cubic-drag"], "also_true": ["input-delay"], "background": None,
        "imperfections": [{"kind": "late-channel"}], "judge": "plant", "visibility_each": {"quadratic-drag": 12.0},
        "noise": {"kind": "white", "recorded_speed_rms": 1.0}, "heldout_clean_speed": [[0.0, 0.0, 0.0]],
    }  # fmt: skip
    return base | changes


def stated(*names: tuple[str, float], **more: Any) -> dict[str, Any]:
    effects = [
        {"name": name, "equation": "mechanical", "probability": p,
         "parameters": {"drag_coefficient": {"value": 2.1, "unit": "N m s^2/rad^2", "interval": [1.9, 2.3]}}}
        for name, p in names
    ]  # fmt: skip
    verdict = "missing-physics" if names else "adequate"
    return {"verdict": verdict, "effects": effects, "set": [n for n, _ in names[:1]]} | more


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "t" / "out").mkdir(parents=True)
    (tmp_path / "t" / "heldout_1.csv").write_text("time [s],speed [rad/s]\n0,0\n1,0\n2,0\n")
    return tmp_path / "t"


def graded(folder: Path, answer: dict[str, Any], said: dict[str, Any] | None) -> Any:
    if said is not None:
        (folder / "out" / "diagnosis.json").write_text(json.dumps(said))
    return grade(answer, folder, folder / "out")


def test_a_right_name_counts_and_its_interval(folder: Path) -> None:
    found = graded(folder, the_answer(), stated(("quadratic-drag", 0.9)))
    assert found.right
    assert found.visibility == 12.0
    assert found.wrong_above(0.5) == ()
    assert [p.covered for p in found.parameters] == [True]
    assert score.brier([found]) == (pytest.approx(0.01), 1)


def test_the_speed_of_an_encoder_lies_on_steps(folder: Path) -> None:
    counted = the_answer(noise={"kind": "encoder", "recorded_speed_rms": 1.0})
    said = stated(("quadratic-drag", 0.9), ("sensor-quantization", 0.99))
    assert graded(folder, counted, said).wrong_above(0.5) == ()
    assert graded(folder, the_answer(), said).wrong_above(0.5) == ("sensor-quantization",)


def test_a_name_of_an_imperfection_is_no_wrong_name_and_no_answer(folder: Path) -> None:
    first = graded(folder, the_answer(), stated(("input-delay", 0.9), ("quadratic-drag", 0.8)))
    assert first.right
    assert first.wrong_above(0.5) == ()
    alone = graded(folder, the_answer(), stated(("input-delay", 0.9)))
    assert not alone.right
    assert alone.wrong_above(0.5) == ()


def test_an_equivalent_name_or_a_small_set_is_right(folder: Path) -> None:
    assert graded(folder, the_answer(), stated(("cubic-drag", 0.9))).right
    small = stated(("backlash", 0.4), set=["backlash", "unbalance", "quadratic-drag"])
    assert graded(folder, the_answer(), small).right
    large = stated(("backlash", 0.4), set=["backlash", "unbalance", "cogging-torque", "quadratic-drag"])
    assert not graded(folder, the_answer(), large).right


def test_a_background_with_a_name_in_the_vocabulary_may_be_named(folder: Path) -> None:
    answer = the_answer(effects=[], equivalent=[], visibility_each={}, background={"kind": "square-root-drag"})
    assert graded(folder, answer, stated(("square-root-drag", 0.9))).wrong_above(0.5) == ()
    wrong = graded(folder, answer, stated(("backlash", 0.9)))
    assert wrong.mode == BACKGROUND_ALONE
    assert wrong.wrong_above(0.5) == ("backlash",)


def test_faults_of_the_recording_are_statements(folder: Path) -> None:
    shift = {"name": "time-shift", "equation": "recording", "probability": 0.99}
    said = {"verdict": "recording-mistake", "effects": [shift], "set": ["time-shift"],
            "beneath": {"verdict": "adequate", "set": []}}  # fmt: skip
    assert graded(folder, the_answer(), said).wrong_above(0.5) == ()
    assert graded(folder, the_answer(also_true=[]), said).wrong_above(0.5) == ("time-shift",)


def test_a_value_that_is_held_is_rightly_called_an_average() -> None:
    assert "speed-moving-average" in also_true(the_answer(also_true=["input-delay", "speed-sensor-lag"]))
    assert "speed-moving-average" not in also_true(the_answer(also_true=["current-sensor-lag"]))


def test_corrected_worse_than_refitted(folder: Path) -> None:
    for name, error in (("simulated", 3.0), ("refitted", 1.0)):
        rows = "".join(f"{k},{error}\n" for k in range(3))
        (folder / "out" / f"heldout_1_{name}.csv").write_text("time [s],speed [rad/s]\n" + rows)
    found = graded(folder, the_answer(), stated(("quadratic-drag", 0.9)))
    assert found.worse == (True,)
    assert score.missed(found)


def test_a_corrected_model_is_compared_with_what_was_recorded_but_for_spikes(folder: Path, tmp_path: Path) -> None:
    """It shows the offset of a sensor as the recording does; a spike is larger than any difference of two models."""
    rows = [3.0] * 40 + [500.0]
    answer, said = the_answer(heldout_clean_speed=[[0.0] * len(rows)]), stated(("sensor-bias", 0.9))
    for corrected, refitted in ((3.0, 0.5), (0.5, 3.0)):
        shown = {tmp_path / "t" / "heldout_1.csv": rows}
        for name, speed in (("simulated", corrected), ("refitted", refitted)):
            shown[folder / "out" / f"heldout_1_{name}.csv"] = [speed] * len(rows)
        for path, speeds in shown.items():
            lines = "".join(f"{k},{w}\n" for k, w in enumerate(speeds))
            path.write_text("time [s],speed [rad/s]\n" + lines)
        assert graded(folder, answer, said).worse == (corrected < refitted,)


def test_between_the_updates_of_a_slow_bus_no_model_is_compared(folder: Path) -> None:
    """The true speed rises row by row and is shown every second row: a model that follows it is no worse for that."""
    held = [{"kind": "values-held", "speed": 2, "current": 1}]
    answer = the_answer(heldout_clean_speed=[[0.0, 0.0, 2.0]], noise={"kind": "white", "recorded_speed_rms": 0.01})
    for name, speeds in (("simulated", (0.0, 1.0, 2.0)), ("refitted", (0.1, 0.1, 2.1))):
        rows = "".join(f"{k},{w}\n" for k, w in enumerate(speeds))
        (folder / "out" / f"heldout_1_{name}.csv").write_text("time [s],speed [rad/s]\n" + rows)
    said = stated(("quadratic-drag", 0.9))
    assert graded(folder, answer | {"imperfections": held}, said).worse == (False,)
    assert graded(folder, answer, said).worse == (True,)


def test_no_diagnosis_states_nothing(folder: Path) -> None:
    found = graded(folder, the_answer(), None)
    assert found.verdict == "no-result"
    assert not found.right
    assert found.stated == ()


def test_targets_and_tables(folder: Path) -> None:
    nothing = the_answer(effects=[], equivalent=[], also_true=[], visibility_each={})
    adequate = stated(adequate_probability=0.9)
    right = graded(folder, the_answer(), stated(("quadratic-drag", 0.9)))
    alarm = graded(folder, nothing, stated(("backlash", 0.9)))
    quiet = graded(folder, nothing, adequate)
    by_name = {t.name: t for t in score.targets([right, alarm, quiet])}
    assert by_name["name right (or in a set of 3), visibility >= 10"].met is True
    assert by_name["nothing missing: a name above 0.5"].found == "50.0 % (1/2)"
    assert by_name["nothing missing: a name above 0.5"].met is False
    assert by_name["Brier, everything stated"].met is False
    assert score.statements([quiet]) == [(0.9, True)]
    rows = score.broken_down([right, replace(alarm, kinds=("hum", "spikes"))], score.BREAKDOWNS["imperfection"])
    assert set(rows) == {"late-channel", "hum", "spikes"}
    console = Console(record=True, width=200)
    for part in tables.shown(BenchGraded(seeds=(5,), split="development", grades=[right, alarm, quiet])):
        console.print(part)
    text = console.export_text()
    for words in ("targets", "by imperfection", "by background", "by judge", "reliability", "misses", "not evidence"):
        assert words in text
