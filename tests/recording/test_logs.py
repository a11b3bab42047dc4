"""Logs of robots and test benches: each format gives the recording that was logged, whichever way its channels ran."""

from __future__ import annotations

import json
import struct
import sys
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest

from one_recording import RADIANS, RPM, TIME, VOLTAGE, imported
from rwn.errors import InputError
from rwn.recording.formats import FORMATS
from rwn.recording.layout import Column, Layout
from rwn.recording.recording import Recording, read_recording

JOINT_STATE = """std_msgs/Header header
string[] name
float64[] position
float64[] velocity
float64[] effort
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
"""


def _layout(**columns: tuple[str, str | None]) -> Layout:
    return Layout(columns={name: Column(source=source, unit=unit) for name, (source, unit) in columns.items()})


def _ros2_bag(path: Path) -> None:
    writer_of = imported("mcap_ros2.writer").Writer
    with path.open("wb") as file:
        writer = writer_of(file)
        joint = writer.register_msgdef("sensor_msgs/msg/JointState", JOINT_STATE)
        number = writer.register_msgdef("std_msgs/msg/Float64", "float64 data")
        for t, u, w in zip(TIME, VOLTAGE, RADIANS, strict=True):
            ns = round(1e9 * t) + 10**18
            stamp = {"sec": ns // 10**9, "nanosec": ns % 10**9}
            state = {
                "header": {"stamp": stamp, "frame_id": ""}, "name": ["idler", "wheel"], "position": [0.0, 1.0],
                "velocity": [7.0, w], "effort": [],
            }  # fmt: skip
            writer.write_message("/voltage", number, {"data": u}, log_time=ns)
            writer.write_message("/joint_states", joint, state, log_time=ns + 12_345_678)  # logged late
        writer.finish()


def _mcap_of_json(path: Path) -> None:
    writer_of = imported("mcap.writer").Writer
    with path.open("wb") as file:
        writer = writer_of(file)
        writer.start()
        schema = writer.register_schema("Motor", "jsonschema", b"{}")
        channel = writer.register_channel("motor", "json", schema)
        for t, u, w in zip(TIME, VOLTAGE, RADIANS, strict=True):
            ns = round(1e9 * t)
            writer.add_message(channel, ns, json.dumps({"u": u, "state": {"w": w}, "note": "ok"}).encode(), ns)
        writer.finish()


def _wpilog_record(entry: int, microseconds: int, payload: bytes) -> bytes:
    return struct.pack("<BBHQ", 0b1110100, entry, len(payload), microseconds) + payload


def _wpilog_start(entry: int, name: str, kind: str, metadata: str) -> bytes:
    texts = b"".join(struct.pack("<I", len(text)) + text.encode() for text in (name, kind, metadata))
    return _wpilog_record(0, 0, struct.pack("<BI", 0, entry) + texts)


def _wpilog(path: Path) -> None:
    content = struct.pack("<6sHI", b"WPILOG", 0x0100, 5) + b"extra"
    content += _wpilog_start(1, "voltage", "double", "Volt")
    content += _wpilog_start(2, "speed", "float", '{"source":"NT"}')
    content += _wpilog_record(0, 0, struct.pack("<BII", 2, 2, 19) + b"Rotation per Second")
    content += _wpilog_start(3, "note", "string", "")
    for k, (t, u, w) in enumerate(zip(TIME, VOLTAGE, RPM, strict=True)):
        content += _wpilog_record(1, round(1e6 * t), struct.pack("<d", u))
        content += _wpilog_record(2, round(1e6 * t), struct.pack("<f", w / 60.0)) + _wpilog_record(3, k, b"hello")
    path.write_bytes(content + _wpilog_record(1, 9, struct.pack("<d", 1.0))[:-3])  # cut off: the robot was switched off


def _tdms(path: Path) -> None:
    nptdms = imported("nptdms")
    speed, voltage = (
        nptdms.ChannelObject("Bench", name, values, properties={"unit_string": unit, "wf_increment": 0.02})
        for name, values, unit in (("speed", RPM, "rpm"), ("voltage", VOLTAGE, "V"))
    )
    with nptdms.TdmsWriter(path) as writer:
        writer.write_segment([voltage, speed])


def _tdms_with_times(path: Path) -> None:
    nptdms = imported("nptdms")
    columns = {"time": (TIME, "s"), "voltage": (VOLTAGE, "V"), "speed": (RPM, "rpm")}
    with nptdms.TdmsWriter(path) as writer:
        for name, (values, unit) in columns.items():
            writer.write_segment([nptdms.ChannelObject("Bench", name, values, properties={"unit_string": unit})])
        writer.write_segment([nptdms.ChannelObject("Other", "temperature", TIME)])


def _mdf(path: Path) -> None:
    asammdf = imported("asammdf")
    with asammdf.MDF(version="4.10") as file:
        signals = (("voltage", VOLTAGE, "V"), ("speed", RPM, "rpm"))
        for name, values, unit in signals:  # a group each, as a bus logger writes it
            file.append([asammdf.Signal(samples=values, timestamps=TIME, name=name, unit=unit)])
        file.save(path, overwrite=True)


def _sysid(path: Path) -> None:
    rows = [[t + 40.0, u, w, w] for t, u, w in zip(TIME, VOLTAGE, RPM / 60.0, strict=True)]
    about = {"sysid": True, "test": "Simple", "units": "Rotations", "unitsPerRotation": 1.0}
    path.write_text(json.dumps({**about, "slow-forward": rows, "fast-backward": rows[:60]}))


ROS2 = _layout(voltage=("/voltage.data", "V"), speed=("/joint_states.wheel.velocity", "rad/s"))
# name of the file, what writes it, what is read, how
LOGS: dict[str, tuple[str, Callable[[Path], None], str, Layout]] = {
    "ROS 2 bag": ("run.mcap", _ros2_bag, "run.mcap", ROS2),
    "MCAP of JSON": (
        "run.mcap", _mcap_of_json, "run.mcap", _layout(voltage=("motor.u", "V"), speed=("motor.state.w", "rad/s")),
    ),
    "WPILOG": ("run.wpilog", _wpilog, "run.wpilog", Layout()),
    "TDMS": ("run.tdms", _tdms, "run.tdms", Layout()),
    "TDMS with times": ("run.tdms", _tdms_with_times, "run.tdms#Bench", Layout()),
    "MDF4": ("run.mf4", _mdf, "run.mf4", Layout()),
    "SysId": ("run.json", _sysid, "run.json#slow-forward", Layout()),
}  # fmt: skip


@pytest.mark.parametrize("kind", [pytest.param(k, marks=pytest.mark.slow) if k == "MDF4" else k for k in LOGS])
def test_a_log_gives_the_recording_that_was_logged(kind: str, tmp_path: Path) -> None:
    name, write, named, layout = LOGS[kind]
    write(tmp_path / name)
    read = read_recording(tmp_path / named, layout=layout)
    assert read.name == named
    np.testing.assert_allclose(np.diff(read.time), 0.02, atol=1e-6)
    begin = 80 - len(read)  # where the joint's stamp is later than the voltage's first
    assert begin == 0
    np.testing.assert_allclose(read.signals["voltage"], VOLTAGE, rtol=1e-12)
    np.testing.assert_allclose(read.signals["speed"], RADIANS, rtol=1e-6, atol=1e-6)


@pytest.mark.parametrize(("kind", "module"), [("ROS 2 bag", "mcap"), ("TDMS", "tdms")])
def test_more_samples_than_memory_is_meant_for_are_refused(
    kind: str, module: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    name, write, named, layout = LOGS[kind]
    write(tmp_path / name)
    monkeypatch.setattr(f"rwn.recording.formats.{module}.MAX_SAMPLES", TIME.size - 1)
    with pytest.raises(InputError, match=r"80 samples are too many.*cut out the part"):
        read_recording(tmp_path / named, layout=layout)


def test_channels_that_are_not_asked_for_are_named_and_not_read(tmp_path: Path) -> None:
    _wpilog(tmp_path / "a.wpilog")
    table = FORMATS[".wpilog"](tmp_path / "a.wpilog", {"voltage"})
    assert set(table.columns) == {"time", "voltage"}
    assert table.units == {"time": "s", "voltage": "volt", "speed": "rotation per second"}


@pytest.mark.parametrize("ending", [".mcap", ".wpilog", ".tdms", pytest.param(".mf4", marks=pytest.mark.slow), ".json"])
def test_a_damaged_log_is_refused_in_one_line(ending: str, tmp_path: Path) -> None:
    name, write, _, _ = next(log for log in LOGS.values() if log[0].endswith(ending))
    write(tmp_path / name)
    content = (tmp_path / name).read_bytes()
    rng = np.random.default_rng(0)
    for _ in range(12):
        damaged = bytearray(content[: int(rng.integers(len(content)))])
        for at in rng.integers(max(len(damaged), 1), size=4) if damaged else ():
            damaged[at] = int(rng.integers(256))
        (tmp_path / name).write_bytes(damaged)
        with suppress(InputError):  # and nothing else
            read_recording(tmp_path / name)


@pytest.mark.parametrize(
    ("ending", "module", "extra"),
    [(".mcap", "mcap.reader", "mcap"), (".tdms", "nptdms", "tdms"), (".mf4", "asammdf", "mdf")],
)
def test_the_extra_of_a_missing_library_is_named(
    ending: str, module: str, extra: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / f"a{ending}").write_bytes(b"x")
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(InputError, match=rf"pip install 'rwn\[{extra}\]'"):
        read_recording(tmp_path / f"a{ending}")


def test_the_libraries_of_logs_are_not_imported_with_rwn() -> None:
    import subprocess

    script = "import rwn, sys; print([m for m in ('mcap', 'nptdms', 'asammdf', 'pandas', 'h5py') if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_records_are_those_of_the_specification(tmp_path: Path) -> None:
    """The bytes of the examples in datalog.adoc: an integer entry `test`, its value 3 after one second."""
    example = "57 50 49 4c 4f 47 00 01 00 00 00 00"  # the header
    example += "20 00 1a 40 42 0f 00 01 00 00 00 04 00 00 00 74 65 73 74 05 00 00 00 69 6e 74 36 34 00 00 00 00"
    (tmp_path / "a.wpilog").write_bytes(bytes.fromhex(example + "20 01 08 40 42 0f 03 00 00 00 00 00 00 00"))
    table = FORMATS[".wpilog"](tmp_path / "a.wpilog", {"test"})
    assert table.columns["time"].tolist() == [1.0]
    assert table.columns["test"].tolist() == [3.0]


def test_a_slower_channel_is_held_and_rows_before_it_are_left_out(tmp_path: Path) -> None:
    content = struct.pack("<6sHI", b"WPILOG", 0x0100, 0)
    content += _wpilog_start(1, "voltage", "double", "volt")
    content += _wpilog_start(2, "speed", "double[]", "radian per second")
    records = [(1, 0.015, 12.0), *((2, 0.01 * k, float(k)) for k in range(8)), (1, 0.055, -12.0), (2, 0.07, 7.5)]
    for entry, at, value in records:
        content += _wpilog_record(entry, round(1e6 * at), struct.pack("<d", value))
    (tmp_path / "a.wpilog").write_bytes(content)
    table = FORMATS[".wpilog"](tmp_path / "a.wpilog", {"voltage", "speed[0]"})
    assert table.columns["speed[0]"].tolist() == [2.0, 3.0, 4.0, 5.0, 6.0, 7.5]  # of an instant twice the last
    assert table.columns["voltage"].tolist() == [12.0, 12.0, 12.0, 12.0, -12.0, -12.0]
    np.testing.assert_allclose(table.columns["time"], 0.01 * np.arange(2, 8))
    assert table.units == {"time": "s", "voltage": "volt", "speed[0]": "radian per second"}


@pytest.mark.slow  # asammdf is imported
def test_which_of_several_channels_of_one_name_is_read_is_said(tmp_path: Path) -> None:
    asammdf = imported("asammdf")
    with asammdf.MDF(version="4.10") as file:
        for name, values, unit in (("voltage", VOLTAGE, "V"), ("speed", RPM, "rpm"), ("speed", 2.0 * RPM, "rpm")):
            file.append([asammdf.Signal(samples=values, timestamps=TIME, name=name, unit=unit)])
        file.save(tmp_path / "a.mf4", overwrite=True)
    read = read_recording(tmp_path / "a.mf4")
    np.testing.assert_allclose(read.signals["speed"], RADIANS)
    assert read.warnings == (f"{tmp_path / 'a.mf4'}: 2 channels are called 'speed': the first is read",)


def test_a_file_of_several_runs_asks_for_one(tmp_path: Path) -> None:
    _sysid(tmp_path / "run.json")
    with pytest.raises(InputError, match=r"holds several runs: slow-forward, fast-backward.*run.json#slow-forward"):
        read_recording(tmp_path / "run.json")
    with pytest.raises(InputError, match=r"no part 'slow'.*one of slow-forward, fast-backward"):
        read_recording(tmp_path / "run.json#slow")
    with pytest.raises(InputError, match="no such file"):
        read_recording(tmp_path / "nowhere.json#slow-forward")
    (tmp_path / "run.csv").write_text("time [s],voltage [V],speed [rpm]\n" + "".join(f"{t},1,{t}\n" for t in TIME))
    with pytest.raises(InputError, match="a file with parts"):
        read_recording(tmp_path / "run.csv#a")
    (tmp_path / "run.csv").rename(tmp_path / "run#1.csv")
    assert read_recording(tmp_path / "run#1.csv").name == "run#1.csv"


def test_the_sides_of_a_drivetrain_are_parts(tmp_path: Path) -> None:
    rows = [[t, u, -u, w, w, w, 2.0 * w, 0.0, 0.0] for t, u, w in zip(TIME, VOLTAGE, RADIANS, strict=True)]
    (tmp_path / "run.json").write_text(json.dumps({"test": "Drivetrain", "units": "Meters", "fast-forward": rows}))
    left, right = (read_recording(tmp_path / f"run.json#fast-forward.{side}") for side in ("left", "right"))
    assert isinstance(left, Recording)
    assert left.linear
    np.testing.assert_allclose(left.signals["speed"], RADIANS)
    np.testing.assert_allclose(right.signals["speed"], 2.0 * RADIANS)
    np.testing.assert_allclose(right.signals["voltage"], -VOLTAGE)


@pytest.mark.parametrize(
    "rows", ["[[0, 0, 0]]", "[1, 2]", '"x"', "[[0, 0, 0, 0], [0]]", "[[0, 0, 0, 0]], \"units\": 3", "[]"]
)
def test_rows_that_are_no_test_are_refused(rows: str, tmp_path: Path) -> None:
    (tmp_path / "a.json").write_text(f'{{"units": "Radians", "slow-forward": {rows}}}')
    with pytest.raises(InputError, match="no JSON of WPILib SysId"):
        read_recording(tmp_path / "a.json")


@pytest.mark.parametrize("content", ["[]", "{}", '{"units": "Radians"}', "[" * 100_000, "\x00"])
def test_what_is_no_sysid_is_refused(content: str, tmp_path: Path) -> None:
    (tmp_path / "a.json").write_text(content)
    with pytest.raises(InputError, match="no JSON of WPILib SysId"):
        read_recording(tmp_path / "a.json")


def test_recordings_of_real_robots_are_read(shared: Path) -> None:
    folder = shared / "data" / "frc_sysid"
    run = read_recording(folder / "simple_mechanism.json#fast-forward")
    assert (len(run), sorted(run.signals), run.linear) == (1287, ["position", "speed", "voltage"], False)
    assert read_recording(folder / "drivetrain_4277.json#slow-forward.left").linear
