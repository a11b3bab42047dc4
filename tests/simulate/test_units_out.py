"""What is simulated for a file is written in the units of that file."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from command_line import MODEL
from rwn.cli import app
from rwn.errors import InputError
from rwn.recording.recording import read_recording, write_csv

TIME = np.arange(200) * 1e-3
VOLTAGE = 6.0 * np.sign(np.sin(40.0 * TIME))


def _simulated(folder: Path, header: str, columns: list[np.ndarray], recording: str = "") -> tuple[str, Path]:
    (folder / "motor.toml").write_text(f"{MODEL}[recording]\n{recording}\n")
    np.savetxt(folder / "run.csv", np.column_stack(columns), fmt="%.9g", delimiter=",", header=header, comments="")
    out = folder / "out.csv"
    arguments = ["simulate", str(folder / "motor.toml"), "--input", str(folder / "run.csv"), "--out", str(out)]
    assert CliRunner().invoke(app, [*arguments, "--overwrite"]).exit_code == 0
    return out.read_text().splitlines()[0], out


def test_units_come_out_as_they_went_in(tmp_path: Path) -> None:
    speed = np.zeros(TIME.size)
    header, out = _simulated(tmp_path, "time [s],voltage [V],speed [rad/s]", [TIME, VOLTAGE, speed])
    assert header == "time [s],current [A],speed [rad/s],position [rad]"
    plain = read_recording(out)
    columns = [1e3 * TIME, 1e3 * VOLTAGE, speed, speed]
    header, out = _simulated(tmp_path, "time [ms],voltage [mV],current [mA],speed [rpm]", columns)
    assert header == "time [ms],current [mA],speed [rpm],position [rad]"
    again = read_recording(out)
    assert float(np.loadtxt(out, delimiter=",", skiprows=1)[-1, 0]) == pytest.approx(1e3 * TIME[-1])
    for name, values in plain.signals.items():
        np.testing.assert_allclose(again.signals[name], values, rtol=1e-7, atol=1e-7)


def test_a_unit_of_the_map_counts_and_one_of_another_quantity_does_not(tmp_path: Path) -> None:
    columns = 'columns.speed = { source = "tacho", scale = "20 rad/s/V" }\ncolumns.time = { unit = "ms" }'
    given = [1e3 * TIME, VOLTAGE, 0.0 * TIME]
    header, _ = _simulated(tmp_path, "time,voltage [V],tacho [V]", given, columns)
    assert header == "time [ms],current [A],speed [rad/s],position [rad]"


def test_a_unit_of_another_signal_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="wrong dimension"):
        write_csv(tmp_path / "a.csv", TIME, {"speed": VOLTAGE}, units={"speed": "mA"})
