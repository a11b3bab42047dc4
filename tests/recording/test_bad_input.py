"""Every bad input ends alike: exit code 2, one line with the place and the remedy, nothing written."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import scipy.io

from rwn import cli
from rwn.recording.formats.csv import BLOCK

MODEL = """
[motor]
kind = "dc"
resistance = 0.81
inductance = "1.5 mH"
torque_constant = 0.105
back_emf_constant = 0.105
inertia = 3.2e-4
viscous_friction = 7e-5

[uncertainty]
resistance = 0.05
inertia = 0.1
"""


def _rows(n: int = 200) -> list[list[float]]:
    return [[k / 1000, 5 * np.sin(k / 20), 0.1 * np.cos(k / 20), 30 * np.sin(k / 20 - 1)] for k in range(n)]


def _csv(
    header: str = "time [s],voltage [V],current [A],speed [rad/s]", rows: list[list[float]] | None = None
) -> str:
    return header + "\n" + "".join(",".join(f"{x:.9g}" for x in row) + "\n" for row in rows or _rows())


def _with(row: int, column: int, text: str) -> str:
    lines = _csv().splitlines()
    cells = lines[row].split(",")
    cells[column] = text
    lines[row] = ",".join(cells)
    return "\n".join(lines) + "\n"


def _changed(column: int, value: Callable[[int], float]) -> str:
    rows = _rows()
    for k, row in enumerate(rows):
        row[column] = value(k)
    return _csv(rows=rows)


def _from_rest_without_input() -> str:
    return _csv(rows=[[k / 1000, 0.0, 0.1 * np.sin(k / 20), 30 * np.sin(k / 20)] for k in range(200)])


def _without_lines(first: int, last: int) -> str:
    lines = _csv().splitlines()
    return "\n".join(lines[:first] + lines[last:]) + "\n"


def _model(old: str, new: str) -> str:
    assert old in MODEL
    return MODEL.replace(old, new)


# name: (text of the recording, what the line must hold)
RECORDINGS: dict[str, tuple[str, tuple[str, ...]]] = {
    "empty file": ("", ("is empty", "time [s]")),
    "header only": (_csv().splitlines()[0] + "\n", ("0 samples", "at least 50")),
    "two samples": (_csv(rows=_rows(2)), ("2 samples", "at least 50")),
    "no header": (_csv().split("\n", 1)[1], ("line 1", "header row")),
    "missing speed and current": (
        _csv("time [s],voltage [V],a [A],b [rad/s]"),
        ("there is no 'speed'", "speed [rad/s]", "recording.columns"),
    ),
    "missing voltage": (
        _csv("time [s],x [V],current [A],speed [rad/s]"),
        ("there is no 'voltage'", "kind 'dc'"),
    ),
    "missing time": (_csv("k [1],voltage [V],current [A],speed [rad/s]"), ("'time'", "sample_time")),
    "misspelt speed": (
        _csv("time [s],voltage [V],current [A],sped [rad/s]"),
        ("'sped'", "did you mean 'speed'"),
    ),
    "speed by another name": (_csv("time [s],voltage [V],current [A],omega [rad/s]"), ("'omega'", "'speed'")),
    "capital letters": (_csv("time [s],Voltage [V],current [A],speed [rad/s]"), ("'Voltage'", "'voltage'")),
    "no unit": (_csv("time [s],voltage,current [A],speed [rad/s]"), ("'voltage' has no unit", "voltage [V]")),
    "empty unit": (
        _csv("time [s],voltage [V],current [A],speed []"),
        ("'speed' has no unit", "speed [rad/s]"),
    ),
    "unknown unit": (
        _csv("time [s],voltage [V],current [A],speed [furz/s]"),
        ("unknown unit 'furz/s'", "'speed'"),
    ),
    "nearly a unit": (_csv("time [s],voltage [V],current [A],speed [rads/ss]"), ("'rads/ss'", "fix:")),
    "unit of another kind": (
        _csv("time [s],voltage [A],current [A],speed [rad/s]"),
        ("wrong dimension", "[V]"),
    ),
    "time in volts": (_csv("time [V],voltage [V],current [A],speed [rad/s]"), ("'time'", "wrong dimension")),
    "speed in hertz": (_csv("time [s],voltage [V],current [A],speed [Hz]"), ("which angle", "turn/s")),
    "speed in 1/s": (_csv("time [s],voltage [V],current [A],speed [1/s]"), ("which angle", "rad/s")),
    "linear speed on a motor": (
        _csv("time [s],voltage [V],current [A],speed [m/s]"),
        ("linear", "rotary", "[motor]"),
    ),
    "one name twice": (_csv("time [s],voltage [V],voltage [V],speed [rad/s]"), ("two columns", "'voltage'")),
    "brackets left open": (_csv("time [s,voltage [V],current [A],speed [rad/s]"), ("line 1", "name [unit]")),
    "not a number": (_with(10, 3, "abc"), ("line 11", "'abc'", "'speed'")),
    "text after a number": (_with(10, 1, "5 V"), ("line 11", "'5 V'")),
    "empty cell": (_with(20, 2, ""), ("line 21", "'current' is empty")),
    "nan": (_with(30, 3, "nan"), ("line 31", "speed is nan")),
    "infinity": (_with(30, 1, "inf"), ("line 31", "voltage is inf")),
    "nan in time": (_with(30, 0, "nan"), ("line 31", "time is nan")),
    "a value too few": (_csv() + "0.5,1.0,2.0\n", ("line 202", "3 values in 4 columns")),
    "a value too many": (_csv() + "0.5,1,2,3,4\n", ("line 202", "5 values in 4 columns")),
    "time stands still": (_with(41, 0, "0.039"), ("line 42", "stands still at 0.039 s")),
    "time runs back": (_with(41, 0, "0.01"), ("line 42", "runs back at 0.01 s")),
    "a gap": (_without_lines(60, 100), ("line 61", "a gap of 0.041 s", "cut the recording in two")),
    "constant speed": (_changed(3, lambda _: 3.0), ("'speed' is constant (3)", "sensor")),
    "constant current": (_changed(2, lambda _: 0.0), ("'current' is constant (0)", "leave the column out")),
    "no input at all": (_from_rest_without_input(), ("'voltage' is zero throughout", "estimate")),
    "binary": ("\0\1\2\3" * 100, ("not a text file", "CSV")),
}

MODELS: dict[str, tuple[str, tuple[str, ...]]] = {
    "empty model": ("", ("no table [motor]", 'kind = "dc"')),
    "not TOML": (_model("resistance = 0.81", "resistance = 0,81"), ("not valid TOML", "line 4")),
    "misspelt table": (
        _model("[uncertainty]", "[uncertanty]"),
        ("'uncertanty'", "did you mean 'uncertainty'"),
    ),
    "misspelt motor": (_model("[motor]", "[moter]"), ("[motor]", "[moter]")),
    "misspelt key": (_model("inductance", "inductence"), ("'inductence'", "did you mean 'inductance'")),
    "missing key": (_model("inertia = 3.2e-4\n", ""), ("no inertia", "kg m^2", "[motor]")),
    "no kind": (_model('kind = "dc"\n', ""), ("no kind", '"dc"')),
    "unknown kind": (_model('"dc"', '"ac"'), ("unknown kind 'ac'", "dc, axis, lti")),
    "linear dc": (_model('"dc"', '"dc"\nlinear = true'), ("linear", "axis")),
    "true for a number": (_model("3.2e-4", "true"), ("inertia", "true or false", "kg m^2")),
    "list for a number": (_model("3.2e-4", "[1.0]"), ("inertia", "list", "kg m^2")),
    "text for a number": (_model("3.2e-4", '"small"'), ("inertia", "'small'", "kg m^2")),
    "wrong unit": (_model('"1.5 mH"', '"1.5 mF"'), ("inductance", "'mF'", "wrong dimension")),
    "unknown unit": (_model('"1.5 mH"', '"1.5 mHenri"'), ("inductance", "unknown unit 'mHenri'")),
    "negative inertia": (_model("3.2e-4", "-3.2e-4"), ("inertia is -0.00032", "positive")),
    "zero resistance": (_model("0.81", "0.0"), ("resistance is 0", "positive")),
    "negative friction": (_model("7e-5", "-7e-5"), ("viscous_friction", "not negative")),
    "nan": (_model("7e-5", "nan"), ("viscous_friction", "the value is nan", "finite")),
    "doubt of nothing": (
        _model("inertia = 0.1", "mass = 0.1"),
        ("unknown parameter 'mass'", "[uncertainty]"),
    ),
    "negative doubt": (_model("inertia = 0.1", "inertia = -0.1"), ("inertia is -0.1", "0.1 = 10 %")),
    "doubt that is a table": (_model("inertia = 0.1", "inertia = { a = 1 }"), ("uncertainty", "a number")),
    "unknown effect": (
        MODEL + "[effects.coulomb]\ncoulomb_torque = 1\n",
        ("effect 'coulomb'", "coulomb-friction"),
    ),
    "unknown effect parameter": (
        MODEL + "[effects.coulomb-friction]\ncoulomb_torqe = 1.0\n",
        ("'coulomb_torqe'", "did you mean 'coulomb_torque'"),
    ),
    "two second masses": (
        MODEL
        + "[effects.backlash]\ngap = 0.1\nload_inertia = 1e-5\ncontact_rate = 1e3\n"
        + "contact_damping_ratio = 0.3\nload_viscous_share = 0.3\n"
        + "[effects.shaft-compliance]\nstiffness = 1.0\ndamping = 0.01\nload_inertia = 1e-5\n"
        + "load_viscous_share = 0.3\n",
        ("backlash and shaft-compliance each bring a second mass", "one of them"),
    ),
    "effect without values": (MODEL + "[effects.coulomb-friction]\n", ("no coulomb_torque", "N m")),
    "unknown load": (MODEL + "[load.pendulm]\nmass = 1.0\n", ("'pendulm'", "did you mean 'pendulum'")),
    "weightless pendulum": (MODEL + "[load.pendulum]\nmass = 0.0\nlength = 0.1\n", ("mass is 0", "positive")),
    "map of an unknown signal": (
        MODEL + '[recording]\ncolumns.sped = { source = "x" }\n',
        ("'sped'", "'speed'"),
    ),
    "map without source": (
        MODEL + '[recording]\ncolumns.speed = { unit = "rpm" }\n',
        ("column 'speed'", "the column is in [rad/s], the map says 'rpm'"),
    ),
    "map with a wrong key": (
        MODEL + '[recording]\ncolumns.speed = { source = "w", units = "rpm" }\n',
        ("'units'", "did you mean 'unit'"),
    ),
    "map to a column that is not there": (
        MODEL + '[recording]\ncolumns.speed = { source = "w", unit = "rpm" }\n',
        ("no column 'w'", "mapped to speed"),
    ),
    "scale of zero": (
        MODEL + '[recording]\ncolumns.speed = { source = "speed", scale = 0 }\n',
        ("scale is 0",),
    ),
    "unknown start": (MODEL + '[recording]\ninitial = "moving"\n', ("moving", "[recording.initial]")),
    "sample time of zero": (MODEL + "[recording]\nsample_time = 0\n", ("sample_time is 0", "positive")),
}


def _run(arguments: list[str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> str:
    """The one line that a refused command prints."""
    monkeypatch.setattr(sys, "argv", ["rwn", *arguments])
    with pytest.raises(SystemExit) as end:
        cli.main()
    said = capsys.readouterr()
    assert end.value.code == 2
    assert said.out == ""
    (line,) = said.err.splitlines()
    assert line.startswith("rwn: ")
    return line


@pytest.fixture
def refuse(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Callable[..., str]:
    """Runs `rwn diagnose` on these files; asserts that it refuses and leaves the folder as it was."""

    def run(
        recording: str | None = None,
        model: str | None = MODEL,
        *,
        name: str = "run.csv",
        extra: tuple[str, ...] = (),
    ) -> str:
        if recording is not None:
            (tmp_path / name).write_text(recording, encoding="utf-8")
        if model is not None:
            (tmp_path / "model.toml").write_text(model, encoding="utf-8")
        before = sorted(tmp_path.rglob("*"))
        files = [
            str(tmp_path / name),
            "--model",
            str(tmp_path / "model.toml"),
            "--out",
            str(tmp_path / "out"),
        ]
        line = _run(
            ["diagnose", *files, *(text.replace("TMP", str(tmp_path)) for text in extra)], monkeypatch, capsys
        )
        assert sorted(tmp_path.rglob("*")) == before
        return line

    return run


@pytest.mark.parametrize("case", RECORDINGS)
def test_bad_recording(case: str, refuse: Callable[..., str]) -> None:
    text, held = RECORDINGS[case]
    line = refuse(text)
    assert "run.csv" in line
    assert "; expected " in line
    assert "; fix: " in line
    for part in held:
        assert part in line


@pytest.mark.parametrize("case", MODELS)
def test_bad_model(case: str, refuse: Callable[..., str]) -> None:
    text, held = MODELS[case]
    line = refuse(_csv(), text)
    assert "model.toml" in line or "run.csv" in line
    assert "; expected " in line
    assert "; fix: " in line
    for part in held:
        assert part in line


def test_there_are_enough_bad_inputs() -> None:
    assert len(RECORDINGS) + len(MODELS) >= 45


def test_missing_recording(refuse: Callable[..., str]) -> None:
    assert "no such file" in refuse(None)


def test_missing_model(refuse: Callable[..., str]) -> None:
    line = refuse(_csv(), None)
    assert "model.toml" in line
    assert "no such file" in line


def test_recording_given_as_model(refuse: Callable[..., str]) -> None:
    assert "not valid TOML" in refuse(_csv(), _csv())


def test_folder_instead_of_a_recording(refuse: Callable[..., str], tmp_path: Path) -> None:
    (tmp_path / "run.csv").mkdir()
    assert "this is a folder" in refuse()


def test_unknown_kind_of_file(refuse: Callable[..., str]) -> None:
    assert "'.pdf'" in refuse(_csv(), name="run.pdf")


def test_no_spreadsheet(refuse: Callable[..., str]) -> None:
    pytest.importorskip("python_calamine")
    assert "the spreadsheet cannot be read" in refuse(_csv(), name="run.xlsx")


def test_unreadable_file(refuse: Callable[..., str], monkeypatch: pytest.MonkeyPatch) -> None:
    def deny(*_: object) -> str:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr("rwn.recording.formats.csv.encoding_of", deny)
    assert "permission denied" in refuse(_csv())


def test_a_line_that_does_not_end(refuse: Callable[..., str], tmp_path: Path) -> None:
    with (tmp_path / "run.csv").open("wb") as file:
        file.write(b"1,2,3,4," * (BLOCK // 8 + 1))
    line = refuse()
    assert "line 1: the line is longer" in line


def test_mat_without_a_column_map(refuse: Callable[..., str], tmp_path: Path) -> None:
    scipy.io.savemat(tmp_path / "run.mat", {"vir": np.zeros(9), "qm": np.zeros(9)})
    line = refuse(name="run.mat")
    assert "vir, qm" in line
    assert "column map" in line


def test_mat_with_a_wrong_map(refuse: Callable[..., str], tmp_path: Path) -> None:
    scipy.io.savemat(tmp_path / "run.mat", {"RawData": {"Velo": np.zeros(9), "Time": np.zeros(9)}})
    model = MODEL + '[recording]\ncolumns.speed = { source = "RawData.Vello", unit = "rad/s" }\n'
    assert "did you mean 'RawData.Velo'" in refuse(None, model, name="run.mat")


def test_no_mat_file(refuse: Callable[..., str]) -> None:
    model = MODEL + '[recording]\ncolumns.speed = { source = "w", unit = "rad/s" }\n'
    assert "not a .mat file" in refuse("this is text, no matrix\n" * 50, model, name="run.mat")


def test_mat_of_different_lengths(refuse: Callable[..., str], tmp_path: Path) -> None:
    scipy.io.savemat(tmp_path / "run.mat", {"t": np.arange(99.0), "u": np.ones(99), "w": np.ones(98)})
    columns = {"time": ("t", "s"), "voltage": ("u", "V"), "speed": ("w", "rpm")}
    lines = "".join(f'columns.{k} = {{ source = "{s}", unit = "{u}" }}\n' for k, (s, u) in columns.items())
    assert "98 samples, time has 99" in refuse(None, MODEL + "[recording]\n" + lines, name="run.mat")


def test_existing_output(refuse: Callable[..., str], tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "report.html").write_text("mine")
    assert "--overwrite" in refuse(_csv())
    assert (tmp_path / "out" / "report.html").read_text() == "mine"


def test_a_file_where_the_output_folder_goes(refuse: Callable[..., str], tmp_path: Path) -> None:
    (tmp_path / "out").write_text("mine")
    assert "this is a file" in refuse(_csv())


def test_a_folder_that_takes_no_files(refuse: Callable[..., str], monkeypatch: pytest.MonkeyPatch) -> None:
    def deny(**_: object) -> None:
        raise OSError(30, "Read-only file system")

    monkeypatch.setattr("rwn.report.files.tempfile.mkdtemp", deny)
    line = refuse(_csv())
    assert "cannot be written" in line
    assert "choose another --out" in line


def test_a_disk_that_fills_while_writing(refuse: Callable[..., str], monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device", "diagnosis.json")

    monkeypatch.setattr("rwn.diagnose", full)
    line = refuse(_csv())
    assert "diagnosis.json: No space left on device" in line
    assert "; fix: " in line


def test_no_command_shows_the_help(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr(sys, "argv", ["rwn"])
    with pytest.raises(SystemExit) as end:
        cli.main()
    assert end.value.code == 2
    assert "\n  diagnose " in capsys.readouterr().err


def test_judging_by_the_fitted_recording(refuse: Callable[..., str]) -> None:
    assert "given twice" in refuse(_csv(), extra=("--heldout", "TMP/run.csv"))


def test_two_files_after_one_heldout(refuse: Callable[..., str]) -> None:
    line = refuse(_csv(), extra=("--heldout", "b.csv", "c.csv"))
    assert "'c.csv' follows --heldout b.csv" in line


@pytest.mark.parametrize(
    ("arguments", "held"),
    [
        (["diagnos"], "diagnos"),
        (["diagnose", "a.csv"], "--model"),
        (["diagnose", "a.csv", "--model", "m.toml", "--out", "o", "--seed", "x"], "--seed"),
        (["diagnose", "a.csv", "--model", "m.toml", "--out", "o", "--job", "2"], "--job"),
        (["diagnose", "a.csv", "--model", "m.toml", "--out", "o", "--jobs", "0"], "--jobs"),
        (["effects", "nothing-of-the-kind"], "nothing-of-the-kind"),
    ],
)
def test_wrong_usage(
    arguments: list[str], held: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert held in _run(arguments, monkeypatch, capsys)
