from __future__ import annotations

import hashlib
import math
import os
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import made_up
import rwn
from command_line import Run
from rwn.fit.intervals import Estimate
from rwn.model.files import read_model
from rwn.model.model import Model
from rwn.recording.recording import Recording, read_recording, write_csv
from rwn.report import identification
from rwn.report.diagnosis import Diagnosis
from rwn.simulate.explained_signal import ExplainedSignal


@dataclass(frozen=True)
class FakeRun:
    time: np.ndarray
    signals: dict[str, np.ndarray]
    status: str = "ok"
    advice: str = ""


@dataclass(frozen=True)
class FakeIdentification:
    model: Model
    parameters: dict[str, Estimate]
    status: str = "converged"
    advice: str = ""
    not_identifiable: tuple[str, ...] = ()
    residual_over_noise: float = 1.0
    explained: tuple[ExplainedSignal, ...] = ()
    failure: str = ""
    findings: tuple[()] = ()
    warnings: tuple[()] = ()


def _fake_diagnose(calls: list[dict[str, Any]]) -> Callable[..., Diagnosis]:
    def fake(recordings: list[Recording], model: Model, **options: Any) -> Diagnosis:
        options["progress"]("refit", 0.5)
        calls.append({"recordings": recordings, "model": model, **options})
        return replace(made_up.found(), corrected=model)

    return fake


def test_diagnose_writes_its_files(run: Run, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    calls: list[dict[str, Any]] = []
    monkeypatch.setattr(rwn, "diagnose", _fake_diagnose(calls), raising=False)
    code, out, err = run(
        "diagnose", "a.csv", "--model", "model.toml", "--out", "new/out", "--heldout", "b.csv", "--seed", "4"
    )
    assert (code, err) == (0, " 50 %  refit\n")
    (call,) = calls
    assert [r.name for r in call["recordings"]] == ["a.csv"]
    assert [r.name for r in call["heldout"]] == ["b.csv"]
    assert call["seed"] == 4
    folder = tmp_path / "new" / "out"
    assert sorted(f.name for f in folder.iterdir()) == [
        "corrected.toml",
        "curves.json",
        "diagnosis.json",
        "report.html",
    ]
    assert read_model(folder / "corrected.toml") == read_model("model.toml")
    assert Diagnosis.from_json((folder / "diagnosis.json").read_bytes()).verdict == "missing-physics"
    report = (folder / "report.html").read_text(encoding="utf-8")
    assert "--heldout b.csv" in report
    assert hashlib.sha256((tmp_path / "a.csv").read_bytes()).hexdigest()[:12] in report
    assert out.startswith("The model lacks Coulomb friction")
    assert "Coulomb friction: Coulomb torque T_c = 20.8 ± 0.5 mN m" in out


def test_a_failure_half_way_leaves_nothing(run: Run, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(rwn, "diagnose", _fake_diagnose([]), raising=False)

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("rwn.report.diagnosis.page", full)
    code, _, err = run("diagnose", "a.csv", "--model", "model.toml", "--out", "out")
    assert code == 2
    assert "No space left" in err
    assert not (tmp_path / "out").exists()


def test_overwrite_replaces_the_results_and_nothing_else(
    run: Run, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(rwn, "diagnose", _fake_diagnose([]), raising=False)
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "notes.txt").write_text("mine")
    (tmp_path / "out" / "report.html").write_text("old")
    code, _, _ = run("diagnose", "a.csv", "--model", "model.toml", "--out", "out", "--overwrite")
    assert code == 0
    assert (tmp_path / "out" / "notes.txt").read_text() == "mine"
    assert "Coulomb" in (tmp_path / "out" / "report.html").read_text()


def test_simulate_writes_a_recording(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    def fake(_: Model, recording: Recording) -> FakeRun:
        return FakeRun(recording.time, {"voltage": recording.signals["voltage"], "speed": 2 * recording.time})

    monkeypatch.setattr(rwn, "simulate", fake, raising=False)
    code, out, _ = run("simulate", "model.toml", "--input", "a.csv", "--out", "sim.csv")
    assert code == 0
    assert "300 samples" in out
    simulated = read_recording("sim.csv")
    np.testing.assert_allclose(simulated.signals["speed"], 2 * simulated.time)


def _fake_identify(**given: Any) -> Callable[..., FakeIdentification]:
    def fake(_: list[Recording], model: Model) -> FakeIdentification:
        fitted = replace(model, parameters={**model.parameters, "resistance": 0.9})
        estimate = Estimate(value=0.9, unit="ohm", interval=(0.88, 0.92))
        return FakeIdentification(fitted, {"resistance": estimate}, **given)

    return fake


@pytest.fixture
def motor(run: Run, tmp_path: Path) -> None:
    """a.csv as the motor of MODEL with a resistance of 0.9 ohm moves (`run` has written the model)."""
    model = read_model(tmp_path / "model.toml")
    true = replace(model, parameters={**model.parameters, "resistance": 0.9})
    t = np.arange(3000) / 1000
    run = Recording(name="a", time=t, signals={"voltage": 5.0 * np.sign(np.sin(6 * t + 0.1))})
    signals = dict(rwn.simulate(true, run).signals)
    write_csv(tmp_path / "a.csv", t, {"voltage": run.signals["voltage"], "speed": signals["speed"]})


@pytest.mark.usefixtures("motor")
def test_identify_prints_and_writes_the_fitted_model(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    explained = (ExplainedSignal(recording="a.csv", signal="speed", explained=0.98, error=0.2, unit="rad/s"),)
    monkeypatch.setattr(rwn, "identify", _fake_identify(residual_over_noise=3.2, explained=explained), raising=False)
    code, out, err = run("identify", "a.csv", "--model", "model.toml", "--out", "fitted.toml")
    assert (code, err) == (0, "")
    assert "a.csv: 98 % of the variance of the speed is explained, rms error 0.200 rad/s" in out
    assert "0.900 ± 0.020 Ω" in out
    assert "3.2 times the rms of the noise" in out
    assert read_model("fitted.toml").parameters["resistance"] == 0.9
    code, _, err = run("identify", "a.csv", "--model", "model.toml", "--out", "fitted.toml")
    assert code == 2
    assert "exists" in err


@pytest.mark.usefixtures("motor")
def test_identify_fails_where_it_did_not_converge(run: Run, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    failed = _fake_identify(failure="the fit did not converge (iteration-limit): Start closer")
    monkeypatch.setattr(rwn, "identify", failed, raising=False)
    code, _, err = run("identify", "a.csv", "--model", "model.toml", "--out", "fitted.toml")
    assert code == 3
    assert "did not converge (iteration-limit): Start closer; fitted.toml was not written" in err
    assert not (tmp_path / "fitted.toml").exists()


def test_a_sign_error_is_no_identified_motor(run: Run, tmp_path: Path) -> None:
    """The speed of the demonstration with its sign turned."""
    demo = Path(rwn.__file__).parent / "demo"
    recording = read_recording(demo / "train.csv")
    turned = {"voltage": recording.signals["voltage"][:1500], "speed": -recording.signals["speed"][:1500]}
    write_csv(tmp_path / "turned.csv", recording.time[:1500], turned)
    code, _, err = run("identify", "turned.csv", "--model", str(demo / "model.toml"), "--out", "fitted.toml")
    assert code == 3
    assert "check signs" in err
    assert "was not written" in err
    assert not (tmp_path / "fitted.toml").exists()


def test_a_sign_error_of_what_nobody_knows_is_no_identified_motor(run: Run, tmp_path: Path) -> None:
    """The voltage of the demonstration turned, the current alone, and no data sheet: the fit explains most of it."""
    demo = Path(rwn.__file__).parent / "demo"
    recording = read_recording(demo / "train.csv")
    turned = {"voltage": -recording.signals["voltage"][:1500], "current": recording.signals["current"][:1500]}
    write_csv(tmp_path / "turned.csv", recording.time[:1500], turned)
    given = rwn.read_model(demo / "model.toml")
    names = [name for name in given.parameters if name != "inductance"]
    rwn.save(replace(given, uncertainty=dict.fromkeys(names, math.inf)), tmp_path / "unknown.toml")
    code, out, err = run("identify", "turned.csv", "--model", "unknown.toml", "--out", "fitted.toml")
    assert code == 3
    assert "of the variance of the current is explained" in out
    assert "current of the wrong sign: undone, 9" in err
    assert "was not written" in err


def test_identify_says_what_ran_into_a_bound_and_what_is_not_seen() -> None:
    motor = {"resistance": 1.0, "inductance": 1e-3, "torque_constant": 0.1, "back_emf_constant": 0.1, "inertia": 1e-4,
             "viscous_friction": 1e-5}  # fmt: skip
    model = Model(kind="dc", parameters=motor, uncertainty={"resistance": 0.1})
    estimates = {"resistance": Estimate(value=14.6, unit="ohm", interval=(10.0, 14.6))}
    fit = FakeIdentification(model, estimates, not_identifiable=("inertia",))
    said = "\n".join(identification.lines(fit, model))  # type: ignore[arg-type]
    assert "warning: resistance ran into a bound" in said
    assert "add nothing to what was declared of inertia" in said
    assert "times what was given, 27 declared deviations" in said


def test_version(run: Run) -> None:
    assert run("--version")[:2] == (0, rwn.__version__ + "\n")


def test_help_names_every_command(run: Run) -> None:
    code, out, _ = run("--help")
    assert code == 0
    for command in ("diagnose", "simulate", "identify", "effects", "demo"):
        assert command in out


def test_a_bug_is_not_called_bad_input(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_: object, **__: object) -> None:
        raise KeyError("inner")

    monkeypatch.setattr(rwn, "diagnose", broken, raising=False)
    with pytest.raises(KeyError):
        run("diagnose", "a.csv", "--model", "model.toml", "--out", "out")


def test_the_command_line_starts_quickly() -> None:
    heavy = "scipy", "pint", "plotly", "numpy.f2py"
    code = f"import sys, rwn.cli; print([m for m in {heavy} if m in sys.modules])"
    start = os.times()
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    ended = os.times()
    assert loaded.strip() == "[]"
    # Of the processor, so that other work on the machine does not count.
    assert ended.children_user + ended.children_system - start.children_user - start.children_system < 3.0


def test_simulate_needs_the_time_and_the_input_alone(run: Run) -> None:
    Path("model.toml").write_text(
        '[motor]\nkind = "dc"\nresistance = 1.0\ninductance = 0.0\ntorque_constant = 0.05\n'
        "back_emf_constant = 0.05\ninertia = 1e-5\nviscous_friction = 1e-6\n"
    )
    rows = "".join(f"{0.001 * k:.3f},5.0\n" for k in range(60))
    Path("input.csv").write_text("time [s],voltage [V]\n" + rows)
    status, output, _ = run("simulate", "model.toml", "--input", "input.csv", "--out", "sim.csv")
    assert (status, "60 samples" in output) == (0, True)
