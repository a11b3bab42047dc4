"""A column that does not say what its numbers are in: the remedy leads to a file that is read."""

from __future__ import annotations

import tomllib
from pathlib import Path

import numpy as np
import pytest

import rwn
from command_line import MODEL
from rwn.errors import InputError
from rwn.model.toml_reader import parse_model
from rwn.recording.recording import read_recording

RPM = np.pi / 30.0


def _file(folder: Path, header: str) -> Path:
    rows = "".join(f"{k / 1000},{5 * (k % 40 > 20)},{100 + k}\n" for k in range(100))
    (folder / "run.csv").write_text(f"{header}\n{rows}")
    return folder / "run.csv"


def _read(path: Path, recording: str = "") -> rwn.Recording:
    model = parse_model(f"{MODEL}[recording]\n{recording}\n", where="motor.toml")
    return read_recording(path, layout=model.recording)


def _refused(path: Path, recording: str = "") -> str:
    with pytest.raises(InputError) as refusal:
        _read(path, recording)
    return str(refusal.value)


def test_a_unit_alone_is_that_of_the_column_of_the_signals_name(tmp_path: Path) -> None:
    run = _read(_file(tmp_path, "time [s],voltage [V],speed"), 'columns.speed = { unit = "rpm" }')
    assert run.signals["speed"] == pytest.approx((100 + np.arange(100)) * RPM)
    assert set(run.signals) == {"voltage", "speed"}


@pytest.mark.parametrize(
    ("name", "begins"),
    [
        ("speed", "write 'speed [rad/s]', 'speed [rpm]'"),
        ("speed_rpm", "write 'speed [rpm]'"),
        ("speed rpm", "write 'speed [rpm]'"),
        ("rpm", "write 'speed [rpm]'"),
        ("omega", "did you mean 'speed [rad/s]'"),
    ],
)
def test_the_advice_for_a_missing_unit_reads_the_file(name: str, begins: str, tmp_path: Path) -> None:
    path = _file(tmp_path, f"time [s],voltage [V],{name}")
    said = _refused(path)
    assert f"; fix: {begins}" in said
    line = said[said.index("columns.speed") :]
    unit = tomllib.loads(line)["columns"]["speed"]["unit"]
    first = (100 * RPM) if unit == "rpm" else 100.0
    assert _read(path, line).signals["speed"][0] == pytest.approx(first)


def test_a_name_that_is_nearly_that_of_a_signal_keeps_its_unit(tmp_path: Path) -> None:
    said = _refused(_file(tmp_path, "time [s],voltage [V],sped [rpm]"))
    assert "did you mean 'speed'? rename it" in said


def test_a_time_without_a_unit_is_not_said_to_be_missing(tmp_path: Path) -> None:
    said = _refused(_file(tmp_path, "time,voltage,speed"), 'columns.speed = { unit = "rpm" }')
    assert "column 'time' has no unit" in said
    assert "columns.time = { unit = 'ms' }" in said
