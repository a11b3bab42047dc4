"""Recording mistakes put into blind trials, and how a diagnosis of them is marked."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner

from rwn.studies.trials.bench import Recording
from rwn.studies.trials.cli import app
from rwn.studies.trials.grade import Grade, grade_folder
from rwn.studies.trials.score import mistakes
from rwn.studies.trials.seal import seal, unseal
from rwn.studies.trials.spoil import KINDS, Spoilt, spoil
from rwn.studies.trials.trial_files import read_columns, write_recording

EFFECT = {"name": "coulomb-friction", "equation": "mechanical", "parameters": {}}
ANSWER: dict[str, Any] = {
    "verdict": "missing-physics", "effects": [EFFECT], "mode": "plain", "visibility": 10.0, "signals": ["V", "i", "w"],
    "heldout_effect_in_noise": [], "noise": {"speed_rms": 1.0},
}  # fmt: skip


def columns() -> dict[str, Any]:
    t = 1e-3 * np.arange(200)
    return {"time": t, "voltage": np.sin(20 * t), "speed": 30 * np.sin(19 * t), "current": np.cos(20 * t)}


@pytest.fixture
def finished(tmp_path: Path) -> Path:
    """A set of eight trials without held-out recordings."""
    folder = tmp_path / "set"
    names = [f"trial_{k:04d}" for k in range(1, 9)]
    for name in names:
        (folder / name).mkdir(parents=True)
        (folder / name / "model.toml").write_text("")
        write_recording(folder / name / "train_1.csv", Recording(**columns()))
    seal(folder, {"seed": 3, "split": "development", "count": 8, "answers": dict.fromkeys(names, ANSWER)})
    return folder


@pytest.mark.parametrize("delay", [4, -4])
def test_a_channel_out_of_step(delay: int) -> None:
    true = columns()
    seen = Spoilt("time-shift", ("current",), delay=delay).applied(true)
    inner = np.arange(10, 150)
    assert {len(values) for values in seen.values()} == {200 if delay > 0 else 196}
    np.testing.assert_array_equal(seen["current"][inner], true["current"][inner - delay])
    np.testing.assert_array_equal(seen["speed"][inner], true["speed"][inner])


def test_every_kind_comes_up_and_is_sealed(finished: Path, tmp_path: Path) -> None:
    digest = spoil(finished, tmp_path / "spoilt")
    content = unseal(tmp_path / "spoilt")
    assert content["seed"] == 3
    assert {a["mistake"]["name"] for a in content["answers"].values()} == set(KINDS)
    for name, answer in content["answers"].items():
        seen, true = (read_columns(f / name / "train_1.csv") for f in (tmp_path / "spoilt", finished))
        changed = {s for s in true if seen[s].size != true[s].size or not np.allclose(seen[s], true[s])}
        assert changed >= set(answer["mistake"]["signals"])
        if answer["mistake"]["factor"] != 1.0:
            (signal,) = answer["mistake"]["signals"]
            assert seen[signal][50] == pytest.approx(answer["mistake"]["factor"] * true[signal][50], rel=1e-5)
    assert spoil(finished, tmp_path / "again") == digest
    (tmp_path / "spoilt" / "answers.sealed").unlink()  # as after a stop
    with pytest.raises(FileExistsError, match="not empty"):
        spoil(finished, tmp_path / "spoilt")
    assert (tmp_path / "spoilt" / "trial_0001" / "train_1.csv").exists()
    with pytest.raises(ValueError, match="rwn trials make"):
        spoil(tmp_path / "spoilt", tmp_path / "third")
    assert not (tmp_path / "third").exists()


def _graded(folder: Path, effects: list[dict[str, Any]], verdict: str, also: tuple[str, ...] = ()) -> list[Grade]:
    for trial in sorted(p for p in folder.iterdir() if p.is_dir()):
        (trial / "out").mkdir(exist_ok=True)
        beneath = {"verdict": "missing-physics", "set": [e["name"] for e in effects[1:2]]}
        names = [e["name"] for e in effects[:1]]
        said = {"verdict": verdict, "effects": effects, "set": [*names, *also], "beneath": beneath}
        (trial / "out" / "diagnosis.json").write_text(json.dumps(said))
    return grade_folder(folder).grades


def test_a_mistake_that_is_called_so_and_the_physics_beneath_it_count(finished: Path, tmp_path: Path) -> None:
    folder = tmp_path / "spoilt"
    spoil(finished, folder)
    unit = {"name": "wrong-unit", "equation": "recording", "probability": 0.99}
    both = mistakes(_graded(folder, [unit, {**EFFECT, "probability": 1.0}], "recording-mistake"))
    assert str(both["wrong-unit"]["called so"]) == "100.0 % (2/2)"
    assert str(both["wrong-sign"]["called so"]) == "0.0 % (0/2)"
    assert str(both["wrong-unit"]["single effect beneath it right"]) == "100.0 % (2/2)"
    physics = mistakes(_graded(folder, [{**EFFECT, "probability": 1.0}], "missing-physics"))
    assert str(physics["wrong-unit"]["called so"]) == "0.0 % (0/2)"
    either = mistakes(_graded(folder, [unit], "recording-mistake", also=("wrong-gear-ratio",)))
    assert str(either["wrong-gear-ratio"]["called so"]) == "0.0 % (0/2)"
    assert str(either["wrong-gear-ratio"]["or in its set"]) == "100.0 % (2/2)"


def test_command_line(finished: Path, tmp_path: Path) -> None:
    done = CliRunner().invoke(app, ["spoil", str(finished), "--out", str(tmp_path / "spoilt")])
    assert done.exit_code == 0
    assert "SHA-256" in done.output
    again = CliRunner().invoke(app, ["spoil", str(finished), "--out", str(tmp_path / "spoilt")])
    assert "choose another folder" in str(again.exception)
