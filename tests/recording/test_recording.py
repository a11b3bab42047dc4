from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import scipy.io

from rwn.errors import InputError
from rwn.model.files import read_model
from rwn.model.recordings import read_recordings
from rwn.recording.layout import Column, Layout
from rwn.recording.recording import Recording, read_recording, write_csv
from rwn.recording.signals import SIGNALS


def _write(path: Path, header: str, rows: int = 60, delimiter: str = ",", decimal: str = ".") -> Path:
    body = "".join(
        delimiter.join(f"{x:.6f}".replace(".", decimal) for x in (k / 100, k % 7, k / 3)) + "\n"
        for k in range(rows)
    )
    path.write_text(header + "\n" + body, encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("unit", "factor"),
    [
        ("rad/s", 1.0), ("rpm", np.pi / 30), ("RPM", np.pi / 30), ("1/min", np.pi / 30),
        ("deg/s", np.pi / 180), ("°/s", np.pi / 180), ("rev/s", 2 * np.pi), ("turn/s", 2 * np.pi),
        ("krpm", 100 * np.pi / 3),
    ],
)  # fmt: skip
def test_speed_units(tmp_path: Path, unit: str, factor: float) -> None:
    read = read_recording(_write(tmp_path / "a.csv", f"time [ms],voltage [mV],speed [{unit}]"))
    np.testing.assert_allclose(read.signals["speed"], np.arange(60) / 3 * factor, rtol=1e-6, atol=1e-6)
    np.testing.assert_allclose(read.signals["voltage"], np.arange(60) % 7 * 1e-3)
    np.testing.assert_allclose(read.time, np.arange(60) * 1e-5)
    assert not read.linear


def test_torque_written_without_a_space_is_no_number_metre(tmp_path: Path) -> None:
    read = read_recording(_write(tmp_path / "a.csv", "time [s],torque [mNm],speed [rad/s]"))
    np.testing.assert_allclose(read.signals["torque"], np.arange(60) % 7 * 1e-3)


def test_linear_axis(tmp_path: Path) -> None:
    read = read_recording(_write(tmp_path / "a.csv", "time [s],force [kN],position [mm]"))
    assert read.linear
    np.testing.assert_allclose(read.signals["force"], np.arange(60) % 7 * 1e3)
    np.testing.assert_allclose(read.signals["position"], np.arange(60) / 3 * 1e-3, atol=1e-9)


@pytest.mark.parametrize(("delimiter", "decimal"), [(",", "."), (";", ","), (";", "."), ("\t", ",")])
def test_delimiters_and_decimal_commas(tmp_path: Path, delimiter: str, decimal: str) -> None:
    header = delimiter.join(("time [s]", "voltage [V]", "speed [rad/s]"))
    read = read_recording(_write(tmp_path / "a.csv", header, delimiter=delimiter, decimal=decimal))
    assert read.signals["speed"][3] == pytest.approx(1.0)


def test_a_byte_order_mark_comments_and_text_in_other_columns_do_no_harm(tmp_path: Path) -> None:
    rows = "".join(f"{k / 100},{k % 7},ok,{k / 3}\n" for k in range(60))
    text = "\ufeff# bench 3\ntime [s],voltage [V],state,speed [rad/s]\n" + rows
    (tmp_path / "a.csv").write_text(text, encoding="utf-8")
    assert list(read_recording(tmp_path / "a.csv").signals) == ["voltage", "speed"]


def test_column_map_with_scales(tmp_path: Path) -> None:
    path = _write(tmp_path / "a.csv", "t,vir [V],q [deg]")
    layout = Layout(
        columns={
            "time": Column(source="t", unit="s"),
            "torque": Column(source="vir", scale=2.0, scale_unit="N m/V"),
            "position": Column(source="q", scale=-0.5),
        }
    )
    read = read_recording(path, layout=layout)
    np.testing.assert_allclose(read.signals["torque"], 2.0 * (np.arange(60) % 7))
    np.testing.assert_allclose(read.signals["position"], np.arange(60) / 3 * np.pi / 180 * -0.5, atol=1e-7)


def test_mat_with_a_struct_and_a_sample_time(tmp_path: Path) -> None:
    speed = np.sin(np.arange(80) / 9)
    raw = {"Velo": speed[:, None], "Input": np.arange(80, dtype=np.uint8)}
    scipy.io.savemat(tmp_path / "a.mat", {"RawData": raw, "other": np.zeros((500, 500))})
    columns = {
        "voltage": Column(source="RawData.Input", unit="mV"),
        "speed": Column(source="RawData.Velo", unit="rad/s"),
    }
    read = read_recording(tmp_path / "a.mat", layout=Layout(columns=columns, sample_time=0.02))
    np.testing.assert_allclose(read.signals["speed"], speed)
    np.testing.assert_allclose(read.signals["voltage"], np.arange(80) * 1e-3)
    np.testing.assert_allclose(np.diff(read.time), 0.02)


def test_irregular_sampling_is_kept_and_small_gaps_are_warned_of(tmp_path: Path) -> None:
    time = np.cumsum(0.004 + 0.0008 * np.sin(np.arange(100)))
    time[50:] += 0.02
    write_csv(tmp_path / "a.csv", time, {"voltage": np.sin(time), "speed": np.cos(time)})
    read = read_recording(tmp_path / "a.csv")
    np.testing.assert_allclose(read.time, time, rtol=1e-8)
    (warning,) = read.warnings
    assert "line 52" in warning


def test_arrays_are_read_only_contiguous_copies() -> None:
    mine = np.arange(60.0)[::2]
    recording = Recording(name="a", time=np.arange(30), signals={"speed": mine})
    speed = recording.signals["speed"]
    assert speed.flags["C_CONTIGUOUS"]
    assert speed.dtype == np.float64
    with pytest.raises(ValueError, match="read-only"):
        speed[0] = 1.0
    mine[0] = 5.0
    assert speed[0] == 0.0


@pytest.mark.parametrize(
    ("signals", "match"),
    [
        ({"speed": np.zeros(29)}, "29 samples, time has 30"),
        ({"omega": np.zeros(30)}, "rename it to 'speed'"),
        ({"speed": np.zeros((30, 1))}, "no vector"),
        ({"speed": np.zeros(30) * 1j}, "complex"),
    ],
)
def test_wrong_arrays_are_refused(signals: dict[str, np.ndarray], match: str) -> None:
    with pytest.raises(InputError, match=match):
        Recording(name="a", time=np.arange(30.0), signals=signals)


@pytest.mark.parametrize("linear", [False, True])
def test_csv_round_trip(tmp_path: Path, linear: bool) -> None:
    time = np.arange(100) / 1000
    names = ("force", "position") if linear else [name for name in SIGNALS if name != "force"]
    signals = {name: np.sin(time * (k + 30)) for k, name in enumerate(names)}
    write_csv(tmp_path / "a.csv", time, signals, linear=linear)
    again = read_recording(tmp_path / "a.csv")
    assert again.linear == linear
    for name, values in signals.items():
        np.testing.assert_allclose(again.signals[name], values, rtol=1e-8, atol=1e-12)


def test_the_example_cases_read_clean(shared: Path) -> None:
    for folder in sorted((shared / "cases").glob("case_*")):
        model = read_model(folder / "model.toml")
        for recording in read_recordings(sorted(folder.glob("*_?.csv")), model):
            assert not recording.warnings
            assert len(recording) > 2000


def test_emps_reads_with_the_model_that_comes_with_rwn(shared: Path) -> None:
    import rwn

    model = read_model(Path(rwn.__file__).parent / "demo" / "emps.toml")
    folder = shared / "data" / "nonlinear_benchmarks" / "EMPS"
    (recording,) = read_recordings([folder / "DATA_EMPS.mat"], model)
    raw = scipy.io.loadmat(folder / "DATA_EMPS.mat")
    assert recording.linear
    np.testing.assert_allclose(recording.signals["force"], 35.15065 * raw["vir"].ravel())
    np.testing.assert_allclose(recording.signals["position"], raw["qm"].ravel())


def test_a_name_is_shown_as_a_terminal_may_show_it(tmp_path: Path) -> None:
    run = read_recording(_write(tmp_path / "a\x1b[31mb\x07.csv", "time [s],voltage [V],speed [rpm]"))
    assert run.name == r"a\x1b[31mb\x07.csv"
    assert Path(run.source).exists()
    assert "\x1b" not in repr(replace(run, name="a\x1b[31mb"))


def test_a_name_is_a_text() -> None:
    with pytest.raises(InputError, match="name is None; expected text; fix: correct name"):
        Recording(name=None, time=np.arange(3.0), signals={})  # type: ignore[arg-type]
