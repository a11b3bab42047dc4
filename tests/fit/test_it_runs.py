"""A refitted model that cannot be simulated over a recording is no start of a diagnosis."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from command_line import MODEL
from rwn.errors import NoResultError
from rwn.fit.levenberg_marquardt import FitStatus
from rwn.fit.nominal import check_it_begins, check_it_runs, nominal_of
from rwn.fit.preparation import prepare
from rwn.model.files import read_model
from rwn.model.model import Model
from rwn.model.toml_reader import parse_model
from rwn.recording.recording import Recording

OWN = """[own_effects.brake]
term = "torque"
equation = "-c * sqrt({})"
meaning = "a brake"
source = "none"
parameters.c = { unit = "N m", lower = 0.0, upper = 1.0, start = 0.01, strength = true, meaning = "its torque" }
parameters.w = { unit = "rad/s", lower = 1.0, upper = 99.0, start = 10.0, meaning = "its corner" }
[effects.brake]
c = 0.01
w = 10.0
"""
DRIVEN_ON = """[own_effects.driven]
term = "torque"
equation = "c * speed"
meaning = "what drives motion on"
source = "none"
parameters.c = { unit = "N m s/rad", lower = 0.0, upper = 9.0, start = 0.01, strength = true, meaning = "how much" }
[effects.driven]
c = {}
"""


def _run(name: str, volts: float) -> Recording:
    t = np.arange(200) * 1e-3
    return Recording(name=name, time=t, signals={"voltage": volts * np.sin(20.0 * t), "speed": np.sin(20.0 * t - 0.7)})


def _model(folder: Path, formula: str) -> Model:
    (folder / "motor.toml").write_text(MODEL + OWN.replace("{}", formula))
    return read_model(folder / "motor.toml")


def test_a_formula_that_fails_on_one_recording_is_said_with_its_name(tmp_path: Path) -> None:
    model = _model(tmp_path, "1 - speed / w")
    with pytest.raises(NoResultError, match="other, the refitted model: formula-failed: ") as said:
        check_it_runs(*nominal_of([_run("slow", 0.1), _run("other", 5.0)], model))
    assert said.value.status == "formula-failed"
    assert said.value.advice


def test_what_runs_passes(tmp_path: Path) -> None:
    check_it_runs(*nominal_of([_run("a", 5.0)], _model(tmp_path, "abs(speed) / w")))


def test_a_run_that_diverges_is_said(tmp_path: Path) -> None:
    law = {"stiffness": 1.0, "damping": 1e-5, "load_inertia": 4e-4, "load_viscous_share": 0.3}
    heavy = "[effects.shaft-compliance]\n" + "".join(f"{name} = {value}\n" for name, value in law.items())
    (tmp_path / "motor.toml").write_text(MODEL + heavy)
    problem, nominal = nominal_of([_run("a", 5.0)], read_model(tmp_path / "motor.toml"))
    with pytest.raises(NoResultError, match="a, the refitted model: diverged: "):
        check_it_runs(problem, nominal)


@pytest.mark.slow
def test_a_diagnosis_of_it_ends_in_one_line_and_writes_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from command_line import running

    call = running(tmp_path, monkeypatch, capsys)
    (tmp_path / "model.toml").write_text(MODEL + OWN.replace("{}", "speed / w"))
    code, _, said = call("diagnose", "a.csv", "--model", "model.toml", "--out", "out", "--effort", "0.1")
    assert code == 3
    assert next(line for line in said.splitlines() if line.startswith("rwn: ")).endswith(" Nothing was written.")
    assert "Traceback" not in said
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(("rate", "status"), [(20.0, ""), (400.0, "diverged"), (4000.0, "formula-failed")])
def test_a_model_that_runs_away_from_what_was_recorded_is_said_before_a_search(rate: float, status: str) -> None:
    """Within 0.2 s by e^4, by e^80 where doubles round to e^-36, and beyond all numbers."""
    inertia = parse_model(MODEL, where="motor.toml").parameters["inertia"]
    model = parse_model(MODEL + DRIVEN_ON.replace("{}", str(rate * inertia)), where="motor.toml")
    problem = prepare([_run("a", 5.0)], model)
    if not status:
        check_it_begins(problem)
        return
    with pytest.raises(NoResultError, match=f"a, the model as given: {status}: "):
        check_it_begins(problem)


def test_a_nominal_fit_that_has_no_beginning_is_no_result(tmp_path: Path) -> None:
    problem, nominal = nominal_of([_run("a", 5.0)], _model(tmp_path, "abs(speed) / w"))
    lost = replace(nominal, minimum=replace(nominal.minimum, status=FitStatus.DIVERGED))
    with pytest.raises(NoResultError, match="the refitted model: diverged: "):
        check_it_runs(problem, lost)
