"""CSV whose time is instants of a calendar, whose cells blanks separate, or whose columns all lack a unit."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import rwn
from rwn.errors import InputError
from rwn.recording.layout import Column, Layout
from rwn.recording.recording import read_recording

N = 80
TIME = np.arange(N) * 0.0125
SPEED = np.sin(TIME * 9.0).round(6)


def _stamp(k: int, form: str) -> str:
    at = np.datetime64("2024-02-29T23:59:59.500000") + np.timedelta64(12_500 * k, "us")
    text = str(at)
    return {"T": text, " ": text.replace("T", " "), "Z": f"{text}Z", "zone": f"{text}+01:00", "ms": text[:-1]}[form]


def _file(path: Path, head: str, rows: list[str]) -> Path:
    path.write_text(head + "\n" + "\n".join(rows) + "\n")
    return path


@pytest.mark.parametrize("form", ["T", " ", "Z", "zone", "ms"])
@pytest.mark.parametrize("head", ["time", "time [s]"])
@pytest.mark.parametrize("quote", ["", '"'])
def test_instants_are_the_time_since_the_first(form: str, head: str, quote: str, tmp_path: Path) -> None:
    rows = [f"{quote}{_stamp(k, form)}{quote},{w}" for k, w in enumerate(SPEED)]
    read = read_recording(_file(tmp_path / "a.csv", f"{head},speed [rad/s]", rows))
    np.testing.assert_allclose(read.time, TIME, atol=1e-9)
    np.testing.assert_array_equal(read.signals["speed"], SPEED)


def test_instants_beside_decimal_commas(tmp_path: Path) -> None:
    rows = [f"{_stamp(k, ' ')};{w}".replace(".", ",") for k, w in enumerate(SPEED)]
    read = read_recording(_file(tmp_path / "a.csv", "time;speed [rad/s]", rows))
    np.testing.assert_allclose(read.time, TIME, atol=1e-9)
    np.testing.assert_array_equal(read.signals["speed"], SPEED)


@pytest.mark.parametrize("bad", ["2024-06-31T00:00:00", "noon", "", "12.5"])
def test_what_is_no_instant_among_them_is_refused_by_its_line(bad: str, tmp_path: Path) -> None:
    rows = [f"{_stamp(k, 'T')},{w}" for k, w in enumerate(SPEED)]
    rows[30] = f"{bad},0.5"
    with pytest.raises(InputError, match=r"line 32: .* in column 'time' is no instant; .*; fix: "):
        read_recording(_file(tmp_path / "a.csv", "time,speed [rad/s]", rows))


def test_a_bad_cell_beside_an_instant_is_refused_by_its_column(tmp_path: Path) -> None:
    rows = [f"{_stamp(k, 'T')},{w}" for k, w in enumerate(SPEED)]
    rows[30] = f"{_stamp(30, 'T')},fast"
    with pytest.raises(InputError, match=r"line 32: 'fast' in column 'speed' is not a number"):
        read_recording(_file(tmp_path / "a.csv", "time,speed [rad/s]", rows))


@pytest.mark.parametrize("head", ["time [s] speed [rad/s]", "  time [s]    speed (rad/s)", "# time [s] speed [rad/s]"])
@pytest.mark.parametrize("gap", [" ", "    "])
def test_blanks_separate_cells(head: str, gap: str, tmp_path: Path) -> None:
    rows = [f"{gap[1:]}{t:.6g}{gap}{w}{gap[1:]}" for t, w in zip(TIME, SPEED, strict=True)]
    read = read_recording(_file(tmp_path / "a.txt", head, rows))
    np.testing.assert_allclose(read.time, TIME, atol=1e-9)
    np.testing.assert_array_equal(read.signals["speed"], SPEED)


def test_a_row_too_short_between_blanks_is_named(tmp_path: Path) -> None:
    rows = [f"{t:.6g} {w}" for t, w in zip(TIME, SPEED, strict=True)]
    rows[7] = "0.0875"
    with pytest.raises(InputError, match="line 9: 1 values in 2 columns"):
        read_recording(_file(tmp_path / "a.txt", "time [s] speed [rad/s]", rows))


def test_all_columns_without_a_unit_are_named_at_once(tmp_path: Path) -> None:
    rows = [f"{t:.6g},{w},{w}" for t, w in zip(TIME, SPEED, strict=True)]
    path = _file(tmp_path / "a.csv", "time,voltage,speed", rows)
    with pytest.raises(InputError, match="columns 'time', 'voltage', 'speed' have no unit") as said:
        read_recording(path)
    keys = said.value.fix.partition("model file: ")[2]
    motor = '[motor]\nkind = "axis"\ninertia = 1.0\nviscous_friction = 0.1\n[recording]\n'
    (tmp_path / "motor.toml").write_text(motor + keys.replace(" }, ", " }\n") + "\n")
    layout = rwn.read_model(tmp_path / "motor.toml").recording
    assert list(read_recording(path, layout=layout).signals) == ["voltage", "speed"]


def test_a_unit_alone_is_that_of_the_column_that_the_profile_knows(tmp_path: Path) -> None:
    rows = [f"{1e3 * t:.6g},{w}" for t, w in zip(TIME, SPEED, strict=True)]
    path = _file(tmp_path / "a.csv", "time [ms],Axis.NcToPlc.ActVelo", rows)
    layout = Layout(profile="twincat", columns={"speed": Column(source="speed", unit="rpm")})
    np.testing.assert_allclose(read_recording(path, layout=layout).signals["speed"], SPEED * np.pi / 30.0)


@pytest.mark.parametrize(("name", "what"), [("run", "without an ending"), ("run.doc", "unknown kind of file '.doc'")])
def test_a_file_of_an_unknown_kind_is_refused(tmp_path: Path, name: str, what: str) -> None:
    with pytest.raises(InputError, match=what):
        read_recording(_file(tmp_path / name, "time [s],speed [rad/s]", ["0,0"]))


def test_the_folder_of_a_bag_is_its_file(tmp_path: Path) -> None:
    bag = tmp_path / "run"
    bag.mkdir()
    (bag / "metadata.yaml").write_text("")
    with pytest.raises(InputError, match=r"a folder without an \.mcap file"):
        read_recording(bag)
    (bag / "run_0.mcap").write_bytes(b"")
    with pytest.raises(InputError, match=r"run_0\.mcap"):
        read_recording(bag)
    (bag / "run_1.mcap").write_bytes(b"")
    with pytest.raises(InputError, match="split into 2 files"):
        read_recording(bag)
