"""Every format of FORMATS gives the same recording, with the units that the file holds."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime, timedelta
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import scipy.io

from one_recording import NAMED, RPM, TIME, UNITS, VOLTAGE, as_meant, imported, pandas_timetable
from rwn.errors import InputError
from rwn.recording.formats import FORMATS, read_table
from rwn.recording.formats.nested import nested_table
from rwn.recording.layout import Column, Layout
from rwn.recording.recording import read_recording


def _npz(path: Path) -> None:
    np.savez(path, **NAMED)


def _npy(path: Path) -> None:
    table = np.zeros(80, dtype=[("time", float), ("voltage", float), ("speed", np.float32)])
    for name, values in zip(("time", "voltage", "speed"), NAMED.values(), strict=True):
        table[name] = values
    np.save(path, table)


def _npy_with_units(path: Path) -> None:
    table = np.zeros(80, dtype=[(name, float) for name in NAMED])
    for name, values in NAMED.items():
        table[name] = values
    np.save(path, table)


def _parquet(path: Path) -> None:
    pa, parquet = imported("pyarrow"), imported("pyarrow.parquet")
    fields = [
        pa.field("time", pa.float64(), metadata={"unit": "s"}),
        pa.field("voltage [V]", pa.float64()),
        pa.field("speed", pa.float64(), metadata={"units": "rpm"}),
        pa.field("note", pa.string()),
    ]
    parquet.write_table(pa.table([TIME, VOLTAGE, RPM, ["ok"] * 80], schema=pa.schema(fields)), path)


def _excel(path: Path) -> None:
    imported("python_calamine")
    book = imported("openpyxl").Workbook()
    book.active.append(["Recorded by bench 3"])
    book.active.append(["time", "voltage", "speed", "note"])
    book.active.append(["s", "V", "rpm", None])
    for row in zip(TIME, VOLTAGE, RPM, strict=True):
        book.active.append([*map(float, row), "ok"])
    book.save(path)


def _excel_of(path: Path, times: list[Any], *, cover: list[list[str]]) -> Path:
    imported("python_calamine")
    book = imported("openpyxl").Workbook()
    for row in cover:
        book.active.append(row)
    sheet = book.create_sheet("data")
    sheet.append(["time", "voltage [V]", "speed [rpm]"])
    for at, u, w in zip(times, VOLTAGE, RPM, strict=True):
        sheet.append([at, float(u), float(w)])
    book.save(path)
    return path


BEGAN = datetime(2026, 3, 1)  # midnight, which a spreadsheet knows as a day
STEPS = [timedelta(milliseconds=20 * k) for k in range(80)]


@pytest.mark.parametrize("times", [[BEGAN + s for s in STEPS], [(BEGAN + s).time() for s in STEPS], STEPS])
def test_instants_and_durations_of_a_spreadsheet_are_times(times: list[Any], tmp_path: Path) -> None:
    as_meant(read_recording(_excel_of(tmp_path / "a.xlsx", times, cover=[])))


def test_a_sheet_that_says_who_recorded_is_passed_over(tmp_path: Path) -> None:
    path = _excel_of(tmp_path / "a.xlsx", STEPS, cover=[["Operator", "Smith"], ["Bench", "3"]])
    as_meant(read_recording(path))


def test_a_row_of_a_parquet_file_is_called_a_row(tmp_path: Path) -> None:
    _parquet(tmp_path / "run.parquet")
    assert read_table(tmp_path / "run.parquet", ("time",)).row(3) == "row 4"


def _mat(path: Path) -> None:
    scipy.io.savemat(path, {"time": TIME, "voltage": VOLTAGE, "speed": RPM, "other": np.zeros((300, 300))})


def _mat_7_3(path: Path) -> None:
    imported("matio").save_to_mat(str(path), {"time": TIME, "voltage": VOLTAGE, "speed": RPM}, version="v7.3")


BY_MAP = Layout(columns={name: Column(source=name, unit=unit) for name, unit in UNITS.items()})
WRITERS: dict[str, tuple[str, Callable[[Path], None], Layout]] = {
    "npz": (".npz", _npz, Layout()),
    "npy": (".npy", _npy, BY_MAP),
    "npy with units": (".npy", _npy_with_units, Layout()),
    "parquet": (".parquet", _parquet, Layout()),
    "excel": (".xlsx", _excel, Layout()),
    "mat 7": (".mat", _mat, BY_MAP),
    "mat 7.3": (".mat", _mat_7_3, BY_MAP),
}


@pytest.mark.parametrize("kind", WRITERS)
def test_a_format_gives_the_recording_that_was_written(kind: str, tmp_path: Path) -> None:
    ending, write, layout = WRITERS[kind]
    write(tmp_path / f"run{ending}")
    as_meant(read_recording(tmp_path / f"run{ending}", layout=layout))


def test_a_parquet_file_whose_groups_say_other_rows_is_refused_before_memory_is_taken_for_them(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of 12 rows, in a group that says it has 1e11: found by fuzzing."""
    found = Path(__file__).parents[1] / "corpus" / "parquet" / "08c39b0de7a7c8650f539f277f9ff88ab4e12756"
    (tmp_path / "a.parquet").write_bytes(found.read_bytes())
    reads = list[object]()
    monkeypatch.setattr(imported("pyarrow.parquet").ParquetFile, "read", lambda *_, **__: reads.append(0))
    with pytest.raises(InputError, match="the file is not Parquet, or it is damaged"):
        read_recording(tmp_path / "a.parquet")
    assert not reads


@pytest.mark.parametrize(("kind", "module"), [("npz", "table"), ("parquet", "parquet"), ("mat 7", "mat")])
def test_more_samples_than_memory_is_meant_for_are_refused(
    kind: str, module: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    ending, write, layout = WRITERS[kind]
    write(tmp_path / f"run{ending}")
    monkeypatch.setattr(f"rwn.recording.formats.{module}.MAX_SAMPLES", TIME.size)
    as_meant(read_recording(tmp_path / f"run{ending}", layout=layout))
    monkeypatch.setattr(f"rwn.recording.formats.{module}.MAX_SAMPLES", TIME.size - 1)
    with pytest.raises(InputError, match=r"80 samples are too many.*keep every k-th row"):
        read_recording(tmp_path / f"run{ending}", layout=layout)


def test_a_spreadsheet_that_is_too_large_is_not_unpacked(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    _excel(tmp_path / "run.xlsx")
    monkeypatch.setattr("rwn.recording.formats.excel.MAX_BYTES", 2**10)
    with pytest.raises(InputError, match="export the sheet as CSV"):
        read_recording(tmp_path / "run.xlsx")


@pytest.mark.parametrize("ending", sorted(FORMATS))
def test_what_is_no_such_file_is_refused_in_one_line(ending: str, tmp_path: Path) -> None:
    path = tmp_path / f"run{ending}"
    for content in (b"", b"PK\x03\x04 broken", b"no such file at all\n" * 40, np.arange(9.0).tobytes() * 99):
        path.write_bytes(content)
        with pytest.raises(InputError, match="fix: "):
            read_recording(path, layout=BY_MAP)


@pytest.mark.filterwarnings("ignore:duration_to_mat")  # of the writer
@pytest.mark.parametrize("version", ["v7", "v7.3"])
def test_timetables_with_their_times(version: str, tmp_path: Path) -> None:
    matio = imported("matio")
    matio.save_to_mat(str(tmp_path / "a.mat"), {"log": pandas_timetable(), "x": np.ones(3)}, version=version)
    columns = {
        "time": Column(source="log.Time"),
        "voltage": Column(source="log.Voltage", unit="V"),
        "speed": Column(source="log.Speed", unit="rpm"),
    }
    as_meant(read_recording(tmp_path / "a.mat", layout=Layout(columns=columns)))


@pytest.mark.filterwarnings("ignore:duration_to_mat")  # of the writer
@pytest.mark.parametrize("version", ["v7", "v7.3"])
def test_units_of_a_timetable_are_taken(version: str, tmp_path: Path) -> None:
    matio = imported("matio")
    path = str(tmp_path / "a.mat")
    matio.save_to_mat(path, {"log": pandas_timetable()}, version=version)
    raw = matio.load_from_mat(path, raw_data=True)["log"]
    units = np.empty((1, 2), dtype=object)
    units[0, 0], units[0, 1] = np.array(["V"]), np.array(["rpm"])
    raw.properties["any"]["varUnits"][0, 0] = units
    matio.save_to_mat(path, {"log": raw}, version=version)
    columns = {"time": "Time", "voltage": "Voltage", "speed": "Speed"}  # of the only variable: the bare names do
    layout = Layout(columns={name: Column(source=source) for name, source in columns.items()})
    as_meant(read_recording(path, layout=layout))


@pytest.mark.parametrize("began", [None, "2026-03-01"])
def test_the_index_of_times_of_a_frame_is_kept_in_parquet(began: str | None, tmp_path: Path) -> None:
    frame = pandas_timetable().rename(columns={"Voltage": "voltage [V]", "Speed": "speed [rpm]"})
    frame.index = frame.index if began is None else imported("pandas").Timestamp(began) + frame.index
    frame.index.name = None
    imported("pyarrow")
    frame.to_parquet(tmp_path / "a.parquet")
    as_meant(read_recording(tmp_path / "a.parquet"))


def test_struct_arrays_and_matrices(tmp_path: Path) -> None:
    runs = np.zeros((1, 2), dtype=[("u", object), ("w", object)])
    for k, factor in enumerate((0.0, 1.0)):
        runs[0, k] = (factor * VOLTAGE, factor * RPM)
    scipy.io.savemat(tmp_path / "a.mat", {"runs": runs, "M": np.column_stack([VOLTAGE, TIME])})
    columns = {
        "time": Column(source="M(:,2)", unit="s"),
        "voltage": Column(source="runs(2).u", unit="V"),
        "speed": Column(source="runs(2).w", unit="rpm"),
    }
    as_meant(read_recording(tmp_path / "a.mat", layout=Layout(columns=columns)))


def test_objects_and_cells_of_matlab_name_what_they_hold() -> None:
    """As mat-io hands them over: an object has its properties, a cell array its elements by their number."""

    class Log:
        """An object of a class that is not known here."""

        def __init__(self, **properties: Any) -> None:
            self.properties = properties

    cells, lone, deep = (np.empty(n, dtype=object) for n in (2, 1, 1))
    cells[0], cells[1] = TIME, Log(w=RPM)
    lone[0] = VOLTAGE
    deep[0] = Log(a=Log(b=Log(c=Log(d=Log(e=Log(f=Log(g=VOLTAGE)))))))
    content = {"log": Log(cells=cells, lone=lone), "deep": deep}
    wanted = {"log.cells{1}", "log.cells{2}.w", "log.lone"}
    table = nested_table("a.mat", content, content, wanted)
    assert set(table.columns) == set(table.units) == wanted  # what lies deeper than a log does has no name
    np.testing.assert_array_equal(table.columns["log.cells{2}.w"], RPM)


def test_a_matrix_is_not_taken_for_a_signal(tmp_path: Path) -> None:
    scipy.io.savemat(tmp_path / "a.mat", {"M": np.ones((80, 2))})
    with pytest.raises(InputError, match=r"shape \(80, 2\).*'M\(:,1\)'"):
        read_recording(tmp_path / "a.mat", layout=Layout(columns={"speed": Column(source="M", unit="rpm")}))


def _npz_twice(path: Path) -> None:
    np.savez(path, **NAMED, **{"speed [rad/s]": RPM})


def _parquet_twice(path: Path) -> None:
    pa, parquet = imported("pyarrow"), imported("pyarrow.parquet")
    parquet.write_table(pa.table({**NAMED, "speed [rad/s]": RPM}), path)


def _tdms_twice(path: Path) -> None:
    nptdms = imported("nptdms")
    with nptdms.TdmsWriter(path) as writer:
        for name, values in {**NAMED, "speed [rad/s]": RPM}.items():
            writer.write_segment([nptdms.ChannelObject("Bench", name, values)])


@pytest.mark.parametrize("write", [_npz_twice, _parquet_twice, _tdms_twice])
def test_a_signal_that_is_there_in_two_units_is_refused(write: Callable[[Path], None], tmp_path: Path) -> None:
    """Which of them is meant, nobody can guess; the last one was taken without a word."""
    path = tmp_path / f"run.{write.__name__.split('_')[1]}"
    write(path)
    with pytest.raises(InputError, match=r"two columns are called 'speed'; expected each name once; fix: rename"):
        read_recording(path)


def test_a_pickle_in_an_npz_is_not_run(tmp_path: Path) -> None:
    np.savez(tmp_path / "a.npz", **{"speed [rpm]": np.array([{"a": 1}], dtype=object)})
    with pytest.raises(InputError, match="cannot be read"):
        read_recording(tmp_path / "a.npz")


def test_a_library_that_is_missing_is_named_with_its_extra(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "a.parquet").write_bytes(b"PAR1")
    monkeypatch.setitem(__import__("sys").modules, "pyarrow.parquet", None)
    with pytest.raises(InputError, match=r"pip install 'rwn\[parquet\]'"):
        read_recording(tmp_path / "a.parquet")
