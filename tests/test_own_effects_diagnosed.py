"""Effects of a user's own, fitted and named like those that come with rwn."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import rwn
from made_up_motor import BRAKE, BRAKED_NOMINAL, MOTOR, eddies, recorded
from rwn.cli import app
from rwn.model.files import write_model
from rwn.recording.recording import write_csv


@pytest.fixture(scope="module")
def braked() -> rwn.Diagnosis:
    runs = [recorded(seed, eddies) for seed in range(3)]
    return rwn.diagnose(runs[:2], BRAKED_NOMINAL, heldout=runs[2:], jobs=1)


@pytest.mark.slow
def test_a_concealed_eddy_brake_is_named(braked: rwn.Diagnosis) -> None:
    assert braked.verdict == "missing-physics"
    assert [e.name for e in braked.effects] == ["eddy-brake"]
    (effect,) = braked.effects
    assert effect.equation == braked.equation == "mechanical"
    assert effect.probability > 0.9
    assert effect.formula == f"torque = {BRAKE.equation}"
    for name, truth in (("peak", 0.03), ("corner", 40.0)):
        interval = effect.parameters[name].interval
        assert interval is not None
        assert interval[0] < truth < interval[1]
        assert interval[1] - interval[0] < 0.15 * truth
    row = next(r for r in braked.heldout if r.region == "all" and r.signal == "speed")
    assert row.corrected is not None
    assert row.corrected < 1.1 * (row.noise_floor or 0.0)


@pytest.mark.slow
def test_its_corrected_model_is_one_file_that_simulates(braked: rwn.Diagnosis, tmp_path: Path) -> None:
    write_model(braked.corrected, tmp_path / "corrected.toml")
    assert rwn.read_model(tmp_path / "corrected.toml") == braked.corrected
    fresh = recorded(7, eddies)
    write_csv(tmp_path / "run.csv", fresh.time, fresh.signals)
    line = ["simulate", str(tmp_path / "corrected.toml"), "--input", str(tmp_path / "run.csv"), "--out"]
    done = CliRunner().invoke(app, [*line, str(tmp_path / "sim.csv")])
    assert done.exit_code == 0, done.output
    error = rwn.simulate(braked.corrected, fresh).signals["speed"] - fresh.signals["speed"]
    assert np.std(error) < 0.25


@pytest.mark.slow
def test_it_is_not_named_where_it_is_not() -> None:
    runs = [recorded(seed, lambda *_: 0.0) for seed in range(2)]
    found = rwn.diagnose(runs, BRAKED_NOMINAL, jobs=1)
    assert found.verdict == "adequate"


def test_identify_fits_the_motor_around_it() -> None:
    model = replace(BRAKED_NOMINAL, effects={"eddy-brake": {"peak": 0.03, "corner": 40.0}})
    fit = rwn.identify([recorded(3, eddies)], model)
    assert fit.parameters["inertia"].value == pytest.approx(MOTOR["inertia"], rel=0.01)
    assert fit.residual_over_noise < 1.1


def test_effects_lists_those_of_a_model(tmp_path: Path) -> None:
    write_model(BRAKED_NOMINAL, tmp_path / "model.toml")
    shown = CliRunner().invoke(app, ["effects", "eddy-brake", "--model", str(tmp_path / "model.toml")])
    assert shown.exit_code == 0, shown.output
    assert "peak [N m]: most torque; 0 to 0.5" in shown.output
    assert "eddy-brake" in CliRunner().invoke(app, ["effects", "--model", str(tmp_path / "model.toml")]).output


@pytest.mark.slow
def test_the_worked_example_of_the_documentation(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    page = (Path(__file__).parents[1] / "docs/own_effects.md").read_text(encoding="utf-8")
    definition, script = (re.search(rf"```{kind}\n(.*?)```", page, re.DOTALL) for kind in ("toml", "python"))
    assert definition
    assert script
    demo = (Path(rwn.__file__).parent / "demo/model.toml").read_text(encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    Path("motor.toml").write_text(f"{demo}\n{definition[1]}", encoding="utf-8")
    exec(compile(script[1], "make_runs.py", "exec"), {})
    line = "diagnose run1.csv --model motor.toml --heldout run2.csv --out result --jobs 1"
    said = CliRunner().invoke(app, line.split()).output
    wanted = re.search(r"^The model lacks eddy brake.*$", page, re.MULTILINE)
    assert wanted
    assert wanted[0] in said
    assert "Eddy brake: peak = 5.8" in said
