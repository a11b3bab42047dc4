"""WPILib data logs, record by record as the specification has them."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np
import pytest

from rwn.errors import InputError
from rwn.recording.formats.wpilog import read_wpilog
from rwn.recording.layout import Layout
from rwn.recording.recording import read_recording

HEADER = struct.pack("<6sHI", b"WPILOG", 0x0100, 0)


def record(entry: int, at: int, payload: bytes, *, sizes: tuple[int, int, int] = (1, 2, 4)) -> bytes:
    """A record whose entry, length and time [us] take so many bytes."""
    head = (sizes[0] - 1) | (sizes[1] - 1) << 2 | (sizes[2] - 1) << 4
    numbers = zip((entry, len(payload), at), sizes, strict=True)
    return bytes([head]) + b"".join(n.to_bytes(size, "little") for n, size in numbers) + payload


def texts(*of: str) -> bytes:
    return b"".join(struct.pack("<I", len(text.encode())) + text.encode() for text in of)


def start(entry: int, name: str, kind: str = "double", metadata: str = "") -> bytes:
    return record(0, 0, struct.pack("<BI", 0, entry) + texts(name, kind, metadata))


def number(entry: int, at: int, value: float, form: str = "<d") -> bytes:
    return record(entry, at, struct.pack(form, value))


def _read(folder: Path, content: bytes, *wanted: str) -> dict[str, list[float]]:
    (folder / "a.wpilog").write_bytes(content)
    return {name: x.tolist() for name, x in read_wpilog(folder / "a.wpilog", wanted).columns.items()}


def _routine(folder: Path, *motors: str) -> Path:
    """What SysIdRoutineLog of a routine `drive` logs of these motors."""
    kinds = (("voltage", "Volt"), ("position", "Rotation"), ("velocity", "Rotation per Second"), ("current", "Amp"))
    entries = [(f"{kind}-{motor}-drive", unit) for motor in motors for kind, unit in kinds]
    content = HEADER + start(99, "sysid-test-state-drive", "string")
    content += b"".join(start(k, name, metadata=unit) for k, (name, unit) in enumerate(entries, 1))
    for row in range(60):
        content += b"".join(number(k, 20_000 * row, k + 0.01 * row) for k in range(1, len(entries) + 1))
    (folder / "routine.wpilog").write_bytes(content)
    return folder / "routine.wpilog"


def test_the_entries_of_a_routine_are_known_by_their_beginnings(tmp_path: Path) -> None:
    read = read_recording(_routine(tmp_path, "left"), layout=Layout(profile="sysid"))
    first = {"voltage": 1.0, "position": 4.0 * np.pi, "speed": 6.0 * np.pi, "current": 4.0}
    assert {name: values[0] for name, values in read.signals.items()} == pytest.approx(first)
    with pytest.raises(InputError, match=r"voltage-left-drive and voltage-right-drive may both be the voltage.*rename"):
        read_recording(_routine(tmp_path, "left", "right"), layout=Layout(profile="sysid"))


@pytest.mark.parametrize("motors", [("left",), ("left", "right")])
def test_without_the_profile_the_refusal_names_it(motors: tuple[str, ...], tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"no column is called like a signal; .*fix: --profile sysid, which knows"):
        read_recording(_routine(tmp_path, *motors))


def test_what_is_lost_of_a_log_is_said(tmp_path: Path) -> None:
    path = _routine(tmp_path, "left")
    layout = Layout(profile="sysid")
    whole, data = read_recording(path, layout=layout), path.read_bytes()
    assert not any("byte" in warning for warning in whole.warnings)
    path.write_bytes(data[:-3])
    cut = read_recording(path, layout=layout)
    record_size = len(number(1, 20_000 * 59, 0.0))
    assert f"read up to byte {len(data) - record_size} of {len(data) - 3}: what follows" in cut.warnings[0]


@pytest.mark.parametrize("sizes", [(1, 1, 1), (2, 1, 3), (4, 4, 8), (3, 2, 5), (1, 3, 7)])
def test_numbers_of_a_record_take_as_many_bytes_as_its_first_says(sizes: tuple[int, int, int], tmp_path: Path) -> None:
    content = HEADER + start(3, "u") + record(3, 200, struct.pack("<d", 1.5), sizes=sizes) + number(3, 300, 2.5)
    assert _read(tmp_path, content, "u") == {"time": pytest.approx([200e-6, 300e-6]), "u": [1.5, 2.5]}


@pytest.mark.parametrize(
    ("kind", "form", "value"),
    [("boolean", "?", True), ("int64", "<q", -(2**40)), ("float", "<f", 0.5), ("double", "<d", 0.1)],
)
def test_each_kind_of_number_is_read(kind: str, form: str, value: float, tmp_path: Path) -> None:
    assert _read(tmp_path, HEADER + start(1, "u", kind) + number(1, 7, value, form), "u")["u"] == [value]


def test_a_text_after_the_header_is_passed_over(tmp_path: Path) -> None:
    content = struct.pack("<6sHI", b"WPILOG", 0x0105, 9) + b"any text " + start(1, "u") + number(1, 7, 2.0)
    assert _read(tmp_path, content, "u")["u"] == [2.0]


@pytest.mark.parametrize("version", [0x0001, 0x0200, 0x1000])
def test_another_version_of_the_format_is_refused(version: int, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="this is no WPILib data log of version 1"):
        _read(tmp_path, struct.pack("<6sHI", b"WPILOG", version, 0) + start(1, "u"), "u")


@pytest.mark.parametrize("content", [b"", HEADER[:-1], b"X" + HEADER[1:] + start(1, "u"), b"WPILOG"])
def test_what_is_no_log_is_refused(content: bytes, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="this is no WPILib data log of version 1"):
        _read(tmp_path, content, "u")


def test_a_log_of_nothing_is_empty(tmp_path: Path) -> None:
    assert _read(tmp_path, HEADER, "u") == {}


@pytest.mark.parametrize("kept", range(1, 16))
def test_a_log_is_read_up_to_where_it_was_cut_off(kept: int, tmp_path: Path) -> None:
    whole = HEADER + start(1, "u") + number(1, 100, 1.0)
    last = number(1, 200, 2.0)
    assert len(last) == 16
    assert _read(tmp_path, whole + last[:kept], "u")["u"] == ([1.0, 2.0] if kept == 16 else [1.0])
    assert _read(tmp_path, whole + last, "u")["u"] == [1.0, 2.0]


def test_entries_that_are_not_wanted_or_no_numbers_are_named_or_left_out(tmp_path: Path) -> None:
    content = HEADER + start(1, "u") + start(2, "note", "string") + start(5, "w", "double", "Radian_per_Second")
    content += number(1, 7, 2.0) + record(2, 8, b"hello") + number(5, 7, 3.0) + number(9, 7, 4.0)
    (tmp_path / "a.wpilog").write_bytes(content)
    table = read_wpilog(tmp_path / "a.wpilog", {"u", "note"})
    assert {name: x.tolist() for name, x in table.columns.items()} == {"time": [7e-6], "u": [2.0]}
    assert dict(table.units) == {"u": None, "w": "radian per second", "time": "s"}


@pytest.mark.parametrize(
    ("metadata", "unit"),
    [("Volt", "volt"), ("A", "A"), ("mA", "mA"), ("RPM", "rpm"),
     ("Rotation per Second", "rotation per second"), ("", None), ('{"source":"NT"}', None),
     ('{"source":"AdvantageKit","unit":"rad/s"}', "rad/s"), ('{"units": "rpm"}', "rpm"), ('{"unit": 7}', None),
     ("{not JSON", None), ("{" * 5000, None), ("[1]", None), ("Meter per Second", "meter per second"),
     ("from the driver", None), ("m" + " " * 58, "m" + " " * 58), ("m" + " " * 59, None)],
)  # fmt: skip
def test_metadata_are_a_unit_where_they_can_be_read_as_one(metadata: str, unit: str | None, tmp_path: Path) -> None:
    (tmp_path / "a.wpilog").write_bytes(HEADER + start(1, "u", metadata=metadata) + number(1, 7, 2.0))
    assert read_wpilog(tmp_path / "a.wpilog", {"u"}).units["u"] == unit


def test_metadata_may_come_later_and_entries_may_begin_anew(tmp_path: Path) -> None:
    later = record(0, 0, struct.pack("<BI", 2, 1) + texts("Volt"))
    nowhere = record(0, 0, struct.pack("<BI", 2, 8) + texts("Ampere")) + record(0, 0, struct.pack("<BI", 1, 1))
    content = HEADER + start(1, "u") + number(1, 7, 2.0) + later + nowhere
    content += start(6, "u") + number(6, 9, 3.0)  # under another number
    (tmp_path / "a.wpilog").write_bytes(content)
    table = read_wpilog(tmp_path / "a.wpilog", {"u"})
    assert table.columns["u"].tolist() == [2.0, 3.0]
    assert table.units["u"] == "volt"


def test_control_records_that_are_none_are_passed_over(tmp_path: Path) -> None:
    short, two = record(0, 0, b"\0\1\0\0"), record(0, 0, struct.pack("<BI", 0, 1) + texts("u", "double"))
    finish = record(0, 0, struct.pack("<BI", 1, 1) + texts("x", "float", "Ampere"))
    unknown = record(0, 0, struct.pack("<BI", 3, 1) + texts("Ampere"))
    content = HEADER + short + two + number(1, 5, 9.0) + start(1, "u", "double", "Volt") + finish + unknown
    (tmp_path / "a.wpilog").write_bytes(content + number(1, 7, 2.0))
    table = read_wpilog(tmp_path / "a.wpilog", {"u", "x"})
    assert table.columns["u"].tolist() == [2.0]
    assert dict(table.units) == {"u": "volt", "time": "s"}


def test_arrays_are_read_number_by_number_in_the_order_of_their_times(tmp_path: Path) -> None:
    content = HEADER + start(1, "u", "float[]") + start(2, "empty", "float[]")
    for at, values in ((30, (5.0, 6.0, 7.0)), (10, (1.0, 2.0)), (20, (3.0, 4.0))):
        content += record(1, at, struct.pack(f"<{len(values)}f", *values))
    (tmp_path / "a.wpilog").write_bytes(content)
    table = read_wpilog(tmp_path / "a.wpilog", {"u[0]", "u[1]", "u[2]"})
    assert set(table.units) == {"time", "u[0]", "u[1]"}, "what all of them have"
    assert table.columns["u[0]"].tolist() == [1.0, 3.0, 5.0]
    assert table.columns["u[1]"].tolist() == [2.0, 4.0, 6.0]
    assert table.columns["time"].tolist() == pytest.approx([1e-5, 2e-5, 3e-5])


def test_a_record_shorter_than_its_number_is_left_out(tmp_path: Path) -> None:
    content = HEADER + start(1, "u") + number(1, 5, 1.0) + record(1, 6, b"\0\0\0") + number(1, 7, 2.0)
    assert _read(tmp_path, content, "u") == {"time": pytest.approx([5e-6, 7e-6]), "u": [1.0, 2.0]}
