"""Every bad recording ends alike: exit code 2, one line with the place and the remedy, nothing written."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import scipy.io

from bad_input import MODEL, Refuse, csv_text, run_rows
from rwn.recording.formats.csv import BLOCK


def _with(row: int, column: int, text: str) -> str:
    lines = csv_text().splitlines()
    cells = lines[row].split(",")
    cells[column] = text
    lines[row] = ",".join(cells)
    return "\n".join(lines) + "\n"


def _changed(column: int, value: Callable[[int], float]) -> str:
    rows = run_rows()
    for k, row in enumerate(rows):
        row[column] = value(k)
    return csv_text(rows=rows)


def _from_rest_without_input(voltage: float = 0.0) -> str:
    return csv_text(rows=[[k / 1000, voltage, 0.1 * np.sin(k / 20), 30 * np.sin(k / 20)] for k in range(200)])


def _without_lines(first: int, last: int) -> str:
    lines = csv_text().splitlines()
    return "\n".join(lines[:first] + lines[last:]) + "\n"


# name: (text of the recording, what the line must hold)
RECORDINGS: dict[str, tuple[str, tuple[str, ...]]] = {
    "empty file": ("", ("is empty", "time [s]")),
    "header only": (csv_text().splitlines()[0] + "\n", ("0 samples", "at least 50")),
    "two samples": (csv_text(rows=run_rows(2)), ("2 samples", "at least 50")),
    "no header": (csv_text().split("\n", 1)[1], ("line 1", "header row")),
    "missing speed and current": (
        csv_text("time [s],voltage [V],a [A],b [rad/s]"),
        ("there is no 'speed'", "speed [rad/s]", "recording.columns"),
    ),
    "missing voltage": (
        csv_text("time [s],x [V],current [A],speed [rad/s]"),
        ("there is no 'voltage'", "not used: x", "kind 'dc'"),
    ),
    "missing time": (csv_text("k [1],voltage [V],current [A],speed [rad/s]"), ("'time'", "sample_time")),
    "misspelt speed": (
        csv_text("time [s],voltage [V],current [A],sped [rad/s]"),
        ("'sped'", "did you mean 'speed'"),
    ),
    "speed by another name": (csv_text("time [s],voltage [V],current [A],omega [rad/s]"), ("'omega'", "'speed'")),
    "capital letters": (csv_text("time [s],Voltage [V],current [A],speed [rad/s]"), ("'Voltage'", "'voltage'")),
    "no unit": (csv_text("time [s],voltage,current [A],speed [rad/s]"), ("'voltage' has no unit", "voltage [V]")),
    "empty unit": (
        csv_text("time [s],voltage [V],current [A],speed []"),
        ("'speed' has no unit", "speed [rad/s]"),
    ),
    "unknown unit": (
        csv_text("time [s],voltage [V],current [A],speed [furz/s]"),
        ("unknown unit 'furz/s'", "'speed'"),
    ),
    "nearly a unit": (csv_text("time [s],voltage [V],current [A],speed [rads/ss]"), ("'rads/ss'", "fix:")),
    "unit of another kind": (
        csv_text("time [s],voltage [A],current [A],speed [rad/s]"),
        ("wrong dimension", "[V]"),
    ),
    "time in volts": (csv_text("time [V],voltage [V],current [A],speed [rad/s]"), ("'time'", "wrong dimension")),
    "speed in hertz": (csv_text("time [s],voltage [V],current [A],speed [Hz]"), ("which angle", "turn/s")),
    "speed in 1/s": (csv_text("time [s],voltage [V],current [A],speed [1/s]"), ("which angle", "rad/s")),
    "linear speed on a motor": (
        csv_text("time [s],voltage [V],current [A],speed [m/s]"),
        ("linear", "rotary", "[motor]"),
    ),
    "one name twice": (csv_text("time [s],voltage [V],voltage [V],speed [rad/s]"), ("two columns", "'voltage'")),
    "brackets left open": (csv_text("time [s,voltage [V],current [A],speed [rad/s]"), ("line 1", "name [unit]")),
    "not a number": (_with(10, 3, "abc"), ("line 11", "'abc'", "'speed'")),
    "text after a number": (_with(10, 1, "5 V"), ("line 11", "'5 V'")),
    "empty cell": (_with(20, 2, ""), ("line 21", "'current' is empty")),
    "nan": (_with(30, 3, "nan"), ("line 31", "speed is nan")),
    "infinity": (_with(30, 1, "inf"), ("line 31", "voltage is inf")),
    "nan in time": (_with(30, 0, "nan"), ("line 31", "time is nan")),
    "a value too few": (csv_text() + "0.5,1.0,2.0\n", ("line 202", "3 values in 4 columns")),
    "a value too many": (csv_text() + "0.5,1,2,3,4\n", ("line 202", "5 values in 4 columns")),
    "time stands still": (_with(41, 0, "0.039"), ("line 42", "stands still at 0.039 s")),
    "time runs back": (_with(41, 0, "0.01"), ("line 42", "runs back at 0.01 s")),
    "a gap": (_without_lines(60, 100), ("line 61", "a gap of 0.041 s", "cut the recording in two")),
    "constant speed": (_changed(3, lambda _: 3.0), ("'speed' is constant (3)", "sensor")),
    "constant current": (_changed(2, lambda _: 0.0), ("'current' is constant (0)", "leave the column out")),
    "no input at all": (_from_rest_without_input(), ("'voltage' is zero throughout", "estimate")),
    "an input of rounding": (_from_rest_without_input(-3e-17), ("'voltage' is zero throughout", "estimate")),
    "a current of rounding": (_changed(2, lambda _: 3e-17), ("'current' is constant (3e-17)", "leave the column out")),
    "a voltage scaled to nothing": (_changed(1, lambda k: 1e-14 * (k % 7)), ("voltage goes to 6e-14", "unit or scale")),
    "binary": ("\0\1\2\3" * 100, ("not a text file", "CSV")),
}

@pytest.mark.parametrize("case", RECORDINGS)
def test_bad_recording(case: str, refuse: Refuse) -> None:
    text, held = RECORDINGS[case]
    line = refuse(text)
    assert "run.csv" in line
    assert "; expected " in line
    assert "; fix: " in line
    for part in held:
        assert part in line


def test_there_are_enough_bad_recordings() -> None:
    assert len(RECORDINGS) >= 30


def test_missing_recording(refuse: Refuse) -> None:
    assert "no such file" in refuse(None)


def test_folder_instead_of_a_recording(refuse: Refuse, tmp_path: Path) -> None:
    (tmp_path / "run.csv").mkdir()
    assert "this is a folder" in refuse()


def test_unknown_kind_of_file(refuse: Refuse) -> None:
    assert "'.pdf'" in refuse(csv_text(), name="run.pdf")


def test_no_spreadsheet(refuse: Refuse) -> None:
    pytest.importorskip("python_calamine")
    assert "the spreadsheet cannot be read" in refuse(csv_text(), name="run.xlsx")


def test_unreadable_file(refuse: Refuse, monkeypatch: pytest.MonkeyPatch) -> None:
    def deny(*_: object) -> str:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr("rwn.recording.formats.csv.encoding_of", deny)
    assert "permission denied" in refuse(csv_text())


def test_a_line_that_does_not_end(refuse: Refuse, tmp_path: Path) -> None:
    with (tmp_path / "run.csv").open("wb") as file:
        file.write(b"1,2,3,4," * (BLOCK // 8 + 1))
    line = refuse()
    assert "line 1: the line is longer" in line


def test_mat_without_a_column_map(refuse: Refuse, tmp_path: Path) -> None:
    scipy.io.savemat(tmp_path / "run.mat", {"vir": np.zeros(9), "qm": np.zeros(9)})
    line = refuse(name="run.mat")
    assert "vir, qm" in line
    assert "column map" in line


def test_mat_with_a_wrong_map(refuse: Refuse, tmp_path: Path) -> None:
    scipy.io.savemat(tmp_path / "run.mat", {"RawData": {"Velo": np.zeros(9), "Time": np.zeros(9)}})
    model = MODEL + '[recording]\ncolumns.speed = { source = "RawData.Vello", unit = "rad/s" }\n'
    assert "did you mean 'RawData.Velo'" in refuse(None, model, name="run.mat")


def test_no_mat_file(refuse: Refuse) -> None:
    model = MODEL + '[recording]\ncolumns.speed = { source = "w", unit = "rad/s" }\n'
    assert "not a .mat file" in refuse("this is text, no matrix\n" * 50, model, name="run.mat")


def test_mat_of_different_lengths(refuse: Refuse, tmp_path: Path) -> None:
    scipy.io.savemat(tmp_path / "run.mat", {"t": np.arange(99.0), "u": np.ones(99), "w": np.ones(98)})
    columns = {"time": ("t", "s"), "voltage": ("u", "V"), "speed": ("w", "rpm")}
    lines = "".join(f'columns.{k} = {{ source = "{s}", unit = "{u}" }}\n' for k, (s, u) in columns.items())
    assert "98 samples, time has 99" in refuse(None, MODEL + "[recording]\n" + lines, name="run.mat")
