"""Blind trials asked for in a way that cannot be done, or that did not go well: said in one line, nothing lost."""

from __future__ import annotations

import json
from contextlib import nullcontext
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from typer.testing import CliRunner

from rwn.studies.trials import run as trial_runs
from rwn.studies.trials import spoil
from rwn.studies.trials.adapter import heldout_given, model_of_trial
from rwn.studies.trials.bench import Recording
from rwn.studies.trials.bench_trials.grade import grade_folders
from rwn.studies.trials.cli import app
from rwn.studies.trials.make import WORK, make, make_bench
from rwn.studies.trials.score import Bin, Share, brier
from rwn.studies.trials.seal import ANSWERS, seal, unseal
from rwn.studies.trials.tables import heading, reliability_plot
from rwn.studies.trials.trial_files import read_columns, write_recording


def test_a_set_that_cannot_be_made_is_refused_before_anything_is_written(tmp_path: Path) -> None:
    out = tmp_path / "set"
    with pytest.raises(ValueError, match="split is 'training'; it must be one of development, test"):
        make(3, 1, out, split="training")
    with pytest.raises(ValueError, match="the seed must not be negative, the count at least 1"):
        make(3, 0, out)
    with pytest.raises(ValueError, match="judge is 'adams'; it must be one of plant, mujoco"):
        make_bench(3, 1, out, judge="adams")
    assert not out.exists()
    line = ["make", "--seed", "3", "--count", "1", "--out", str(out), "--judge", "plant"]
    assert "give --bench too" in str(CliRunner().invoke(app, line).exception)


def test_an_unfinished_set_is_not_gone_on_with_as_another(tmp_path: Path) -> None:
    (tmp_path / WORK).mkdir()
    (tmp_path / WORK / "set.json").write_text(json.dumps({"seed": 4, "count": 1}))
    with pytest.raises(FileExistsError, match="holds an unfinished set of another seed, count or kind; remove it"):
        make(3, 1, tmp_path)
    assert json.loads((tmp_path / WORK / "set.json").read_text())["seed"] == 4


@pytest.mark.slow
def test_a_part_of_a_set_is_its_first_trials_as_they_are_in_the_whole(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="the first 3 of 2 trials: give a number from 1 to 2"):
        make(3, 2, tmp_path / "part", first=3)
    assert not (tmp_path / "part").exists()
    make(3, 2, tmp_path / "part", first=1, jobs=1)
    make(3, 2, tmp_path / "whole", jobs=1)
    part, whole = ({p.name for p in (tmp_path / name).glob("trial_*")} for name in ("part", "whole"))
    assert (part, whole) == ({"trial_0001"}, {"trial_0001", "trial_0002"})
    for file in (tmp_path / "part" / "trial_0001").iterdir():
        assert file.read_bytes() == (tmp_path / "whole" / "trial_0001" / file.name).read_bytes()


def test_a_seal_that_was_killed_half_way_does_not_look_finished(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Wherever it stops: the set either is not finished, or has answers and hash that belong together."""

    class KilledError(Exception):
        pass

    moved: list[str] = []
    replace = Path.replace

    def killed(self: Path, target: Path) -> Path:
        moved.append(self.name)
        if len(moved) == 2:
            raise KilledError
        return replace(self, target)

    monkeypatch.setattr(Path, "replace", killed)
    with pytest.raises(KilledError):
        seal(tmp_path, {"answers": {"a": 1}})
    assert not (tmp_path / ANSWERS).exists()
    assert len(moved) == 2
    seal(tmp_path, {"answers": {"a": 1}})
    assert unseal(tmp_path) == {"answers": {"a": 1}}


def test_a_finished_set_keeps_no_answers_in_the_clear(tmp_path: Path) -> None:
    """A run that was killed after sealing left them beside the seal; the next one says finished and removes them."""
    seal(tmp_path, {"answers": {"a": 1}})
    (tmp_path / WORK).mkdir()
    (tmp_path / WORK / "trial_0001.json").write_text("{}")
    with pytest.raises(FileExistsError, match="already holds a finished set"):
        make(3, 1, tmp_path)
    assert not (tmp_path / WORK).exists()


def test_resuming_a_set_does_not_write_what_it_is_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Written anew with every start, set.json would be empty for a moment in which a kill leaves it so."""
    (tmp_path / WORK).mkdir()
    (tmp_path / WORK / "set.json").write_text(json.dumps({"seed": 3, "count": 1}))
    before = (tmp_path / WORK / "set.json").stat()
    (tmp_path / WORK / "trial_0001.json").write_text("{}")
    monkeypatch.setattr("rwn.studies.trials.make.workers", lambda _: nullcontext(SimpleNamespace(map=lambda *_: [])))
    monkeypatch.setattr("rwn.studies.trials.make.shutil.rmtree", lambda *_, **__: None)
    make(3, 1, tmp_path)
    after = (tmp_path / WORK / "set.json").stat()
    assert (after.st_ino, after.st_mtime_ns) == (before.st_ino, before.st_mtime_ns)


def test_a_finished_trial_is_not_made_again(tmp_path: Path) -> None:
    """A set of which every trial was made is sealed as it is; its progress is told of what is made alone."""
    (tmp_path / WORK).mkdir()
    (tmp_path / WORK / "trial_0001.json").write_text('{"case": "trial_0001"}')
    told: list[str] = []
    make(3, 1, tmp_path, progress=lambda *seen: told.append(seen[-1]))
    assert not told
    assert not (tmp_path / WORK).exists()
    assert (tmp_path / "answers.sha256").exists()


@pytest.mark.parametrize(("failed", "code"), [([], 0), (["trial_0002", "trial_0007"], 1)])
def test_trials_that_failed_are_named_and_end_otherwise(
    failed: list[str], code: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: dict[str, object] = {}
    monkeypatch.setattr(trial_runs, "run", lambda _, **options: asked.update(options) or failed)
    results = tmp_path / "results"
    done = CliRunner().invoke(app, ["run", str(tmp_path), "--results", str(results), "--jobs", "3"])
    assert done.exit_code == code
    assert (asked["results"], asked["jobs"]) == (results, 3)
    said = "2 failed (see error.txt there): trial_0002, trial_0007" if failed else ""
    assert done.stderr.strip() == said


def test_trials_of_a_bench_are_not_scored_with_others(tmp_path: Path) -> None:
    (tmp_path / "b" / "trial_0001").mkdir(parents=True)
    (tmp_path / "b" / "trial_0001" / "answer.json").write_text('{"effects": []}')
    with pytest.raises(ValueError, match="b holds no bench trials, other folders do; score each kind alone"):
        grade_folders([tmp_path / "b"])


def test_what_was_scored_is_said_with_its_seeds() -> None:
    assert heading("14 trials", 0, (), None) == "14 trials with open answers"
    assert heading("14 trials", 2, (10_005, 10_006), "test") == (
        "14 trials (2 WITHOUT A DIAGNOSIS), seeds 10005, 10006, test split"
    )
    assert "not evidence" in heading("6 trials", 0, (5,), "development")


def test_without_a_stated_name_no_probability_is_judged(tmp_path: Path) -> None:
    score, count = brier([])
    assert np.isnan(score)
    assert count == 0
    pytest.importorskip("plotly")
    bins = [Bin(0.0, 0.5, 0.3, Share(2, 10)), Bin(0.5, 1.0, 0.9, Share(9, 10))]
    reliability_plot(bins, tmp_path / "plot.html")
    page = (tmp_path / "plot.html").read_text()
    assert "<html" in page
    assert len(page) < 1.5e6, "a slim plotly, as in a report"


def test_a_late_channel_without_a_current_is_put_behind_a_gear(tmp_path: Path) -> None:
    """Late against the voltage alone it might as well be a delay of the drive."""
    trial = tmp_path / "trial"
    trial.mkdir()
    (trial / "model.toml").touch()
    time = 1e-3 * np.arange(400)
    speed = 30.0 * np.sin(20.0 * time)
    write_recording(trial / "train_1.csv", Recording(time=time, voltage=np.cos(20.0 * time), speed=speed))
    said = spoil._spoil_trial(trial, tmp_path / "out", "time-shift", np.random.default_rng(0))
    assert said["name"] == "wrong-gear-ratio"
    assert said["signals"] == ["speed"]
    spoilt = read_columns(tmp_path / "out" / "train_1.csv")["speed"]
    np.testing.assert_allclose(spoilt, said["factor"] * read_columns(trial / "train_1.csv")["speed"], rtol=1e-4)


def test_a_task_that_states_what_scales_may_be_off_goes_into_the_model(tmp_path: Path) -> None:
    (tmp_path / "model.toml").write_text('[motor]\nkind = "axis"\ninertia = 1e-3\nviscous_friction = 1e-4\n')
    assert not heldout_given(tmp_path)
    assert not model_of_trial(tmp_path).effects
    (tmp_path / "task.json").write_text('{"heldout": true, "gain_uncertainty": 0.005}')
    assert heldout_given(tmp_path)
    model = model_of_trial(tmp_path)
    assert model.effects == {"sensor-gain": {"speed_gain": 1.0, "current_gain": 1.0}}
    assert set(model.uncertainty.values()) == {0.005}
