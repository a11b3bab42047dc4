"""What a model file may say of how far its values are believed."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest

import rwn
from rwn.errors import InputError
from rwn.fit.intervals import Estimate
from rwn.model.files import read_model, write_model
from rwn.report.nominal_fit import FittedParameter

MOTOR = {
    "resistance": 0.8, "inductance": 1e-3, "torque_constant": 0.05, "back_emf_constant": 0.05, "inertia": 5e-5,
    "viscous_friction": 1e-4,
}  # fmt: skip
TEXT = '[motor]\nkind = "dc"\n' + "".join(f"{name} = {value}\n" for name, value in MOTOR.items()) + "[uncertainty]\n"


def _read(folder: Path, line: str) -> rwn.Model:
    (folder / "motor.toml").write_text(TEXT + line + "\n")
    return read_model(folder / "motor.toml")


@pytest.mark.parametrize(
    ("line", "remedy"),
    [
        ("resistance = 5", '0.05 or "5 %", or inf'),
        ('resistance = "500 %"', "0.05"),
        ("resistance = 1e4", "write inf where"),
    ],
)
def test_more_than_everything_is_a_percentage_without_its_sign(line: str, remedy: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="resistance is") as refusal:
        _read(tmp_path, line)
    assert remedy in str(refusal.value)


def test_all_of_a_value_may_be_in_doubt(tmp_path: Path) -> None:
    assert _read(tmp_path, "resistance = 1").uncertainty["resistance"] == 1.0


def test_what_is_not_known_at_all_has_an_infinite_uncertainty(tmp_path: Path) -> None:
    model = _read(tmp_path, "resistance = inf")
    assert model.uncertainty["resistance"] == math.inf
    write_model(model, tmp_path / "again.toml")
    assert read_model(tmp_path / "again.toml") == model


def _recording(seed: int = 1) -> rwn.Recording:
    time = np.arange(2000) * 1e-3
    voltage = 6.0 * np.sign(np.sin(9.0 * time))
    run = rwn.simulate(
        rwn.Model(kind="dc", parameters=MOTOR),
        rwn.Recording(name="input", time=time, signals={"voltage": voltage}),
    )
    rng, level = np.random.default_rng(seed), {"current": 0.02, "speed": 0.1}
    noisy = {name: run.signals[name] + level[name] * rng.standard_normal(time.size) for name in level}
    return rwn.Recording(name="run", time=time, signals={"voltage": voltage, **noisy})


def test_a_fit_finds_what_is_not_known_at_all_from_far_off() -> None:
    off = {**MOTOR, "resistance": 2.4}
    sheet = rwn.Model(kind="dc", parameters=off, uncertainty={"resistance": math.inf})
    found = rwn.identify(_recording(), sheet).parameters["resistance"]
    assert found.interval is not None
    assert found.interval[0] < MOTOR["resistance"] < found.interval[1]


@pytest.mark.slow
def test_a_diagnosis_keeps_what_is_not_known_at_all(tmp_path: Path) -> None:
    sheet = rwn.Model(kind="dc", parameters=MOTOR, uncertainty={"resistance": math.inf, "inertia": 0.1})
    found = rwn.diagnose(_recording(), sheet)
    found.save(tmp_path / "result")
    kept = rwn.Diagnosis.load(tmp_path / "result")
    assert kept == found
    assert kept.nominal_fit.parameters["resistance"].uncertainty is None
    plain = json.loads((tmp_path / "result/diagnosis.json").read_text())
    assert plain["nominal_fit"]["parameters"]["resistance"]["uncertainty"] is None
    assert found.verdict == "adequate"


def test_what_was_not_declared_has_not_moved_from_it() -> None:
    row = FittedParameter(nominal=1.0, uncertainty=None, refitted=Estimate(value=3.0, unit="ohm"))
    assert row.moved == 0.0
