"""What reading a recording warns of is told with the result, by whatever call."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import rwn
from made_up_motor import MOTOR, recorded
from rwn.recording.recording import remarks
from rwn.report.identification import lines


def _with_another_column(path: Path) -> Path:
    run = recorded(1, lambda speed, _: -0.004 * np.sign(speed), samples=600)
    columns = {"time [s]": run.time, "voltage [V]": run.signals["voltage"], "speed [rad/s]": run.signals["speed"]}
    rows = np.column_stack([*columns.values(), run.time])
    np.savetxt(path, rows, delimiter=",", header=",".join([*columns, "temperature [degC]"]), comments="")
    return path


@pytest.mark.slow
def test_columns_that_are_not_used_are_told(tmp_path: Path) -> None:
    path = _with_another_column(tmp_path / "a.csv")
    told = f"{path}: not used: temperature"
    model = rwn.Model(kind="dc", parameters=MOTOR, uncertainty={"inertia": 0.1})
    assert told in rwn.diagnose(path, model, effort=0.1).warnings
    fitted = rwn.identify(path, model)
    assert told in fitted.warnings
    assert f"warning: {told}" in list(lines(fitted, model))
    assert not any("not used" in line for line in lines(replace(fitted, warnings=()), model))


def test_a_remark_of_several_files_is_said_once() -> None:
    time, voltage = 1e-3 * np.arange(100), np.ones(100)

    def told(name: str, *warnings: str) -> rwn.Recording:
        return rwn.Recording(name=name, time=time, signals={"voltage": voltage, "speed": voltage}, warnings=warnings)

    found = remarks([told("a.csv", "a.csv: not used: temp"), told("b.csv", "b.csv: not used: temp", "b.csv: odd: x")])
    assert found == ("a.csv, b.csv: not used: temp", "b.csv: odd: x")
