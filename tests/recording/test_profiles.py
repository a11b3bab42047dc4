"""What tools export is read by their profile, without a column map."""

from __future__ import annotations

import sys
from pathlib import Path

import msgspec
import numpy as np
import pytest
import scipy.io

from rwn import cli
from rwn.errors import InputError
from rwn.model.files import read_model, write_model
from rwn.model.model import Model
from rwn.model.recordings import read_recordings
from rwn.recording.layout import Column, Layout
from rwn.recording.profiles import PROFILES, Profile, ProfileColumn, Wanted, exporters, profile, sources
from rwn.recording.recording import Recording, read_recording
from rwn.recording.signals import COLUMNS
from rwn.recording.units import is_unit

TIME = np.arange(80) * 0.02
VOLTAGE, CURRENT, TORQUE = 5.0 * np.sin(TIME), 0.3 * np.cos(TIME), 0.02 * np.cos(TIME)
SPEED, ANGLE = 30.0 * np.sin(TIME - 0.2), -30.0 * np.cos(TIME - 0.2)
TURN, RPM = 2.0 * np.pi, np.pi / 30.0

# the header of an export, its columns, and the signals in them
EXPORTS: dict[str, tuple[str, list[np.ndarray], tuple[str, ...]]] = {
    "odrive": (
        "time,odrv0.axis0.pos_vel_mapper.vel,odrv0.axis0.motor.foc.Iq_measured,odrv0.axis0.controller.torque_setpoint",
        [TIME, SPEED / TURN, CURRENT, TORQUE], ("torque", "current", "speed"),
    ),
    "moteus": (
        "timestamp,servo_stats.velocity,servo_stats.position,servo_stats.q_A,servo_control.q_V",
        [TIME, SPEED / TURN, ANGLE / TURN, CURRENT, VOLTAGE], ("voltage", "current", "speed", "position"),
    ),
    "dynamixel": (
        "time,Present PWM,Present Current,Present Velocity,Present Position",
        [TIME, VOLTAGE / 0.01356, CURRENT / 2.69e-3, SPEED / RPM / 0.229, ANGLE / TURN * 4096],
        ("voltage", "current", "speed", "position"),
    ),
    "sinamics": (
        "Time;SERVO_02.r0061[0];SERVO_02.r0079[0];SERVO_02.r0078[0]",
        [1e3 * TIME, SPEED / RPM, TORQUE, CURRENT], ("torque", "current", "speed"),
    ),
    "sysid": (
        "timestamp,voltage,velocity,position", [TIME, VOLTAGE, SPEED / TURN, ANGLE / TURN],
        ("voltage", "speed", "position"),
    ),
}  # fmt: skip
TRUE = {"voltage": VOLTAGE, "current": CURRENT, "torque": TORQUE, "speed": SPEED, "position": ANGLE}


def _as_meant(read: Recording, signals: tuple[str, ...]) -> None:
    assert tuple(read.signals) == tuple(name for name in TRUE if name in signals)
    np.testing.assert_allclose(read.time, TIME, atol=1e-9)
    for name in signals:
        np.testing.assert_allclose(read.signals[name], TRUE[name], rtol=1e-6, atol=1e-8)


def _write(path: Path, header: str, columns: list[np.ndarray]) -> Path:
    np.savetxt(path, np.column_stack(columns), fmt="%.12g", delimiter=";" if ";" in header else ",", header=header,
               comments="")  # fmt: skip
    return path


@pytest.mark.parametrize("name", EXPORTS)
def test_an_export_is_read_by_its_profile(name: str, tmp_path: Path) -> None:
    header, columns, signals = EXPORTS[name]
    path = _write(tmp_path / "run.csv", header, columns)
    _as_meant(read_recording(path, layout=Layout(profile=name)), signals)


@pytest.mark.parametrize("name", PROFILES)
def test_a_profile_names_signals_units_and_its_source(name: str) -> None:
    known = profile(name)
    assert len(known.source) > 20
    for signal, column in known.columns.items():
        assert signal in COLUMNS
        assert column.names
        assert column.unit is None or is_unit(column.unit)


@pytest.mark.parametrize("ending", [".npz", ".mat"])
def test_names_of_a_profile_are_found_in_any_letters_and_behind_a_dot(ending: str, tmp_path: Path) -> None:
    """What is found by its profile is read, not only listed."""
    path = tmp_path / f"run{ending}"
    columns = {"Timestamp": TIME, "Velocity": SPEED / TURN, "q_v": VOLTAGE, "other": TIME}
    if ending == ".mat":
        scipy.io.savemat(path, columns)
    else:
        np.savez(path, **columns, **{"log.position": ANGLE / TURN})
    signals = ("voltage", "speed") if ending == ".mat" else ("voltage", "speed", "position")
    _as_meant(read_recording(path, layout=Layout(profile="moteus")), signals)


def test_what_a_profile_takes_for_granted_is_said(tmp_path: Path) -> None:
    """A supply of 12 V is a guess: the torque constant would be off by as much as it."""
    header, columns, _ = EXPORTS["dynamixel"]
    path = _write(tmp_path / "run.csv", header, columns)
    said = " ".join(read_recording(path, layout=Layout(profile="dynamixel")).warnings)
    assert "voltage from 'Present PWM': the PWM's share of a supply of 12 V" in said
    assert "current from 'Present Current': counts of 2.69 mA" in said
    keys = "voltage = { unit = 'dimensionless', scale = '0.02712 V' }\ncolumns.current = { unit = 'mA' }"
    motor = "".join(f"motor.{name} = 1.0\n" for name in ("resistance", "inductance", "torque_constant",
                    "back_emf_constant", "inertia", "viscous_friction"))  # fmt: skip
    recording = f"[recording]\nprofile = 'dynamixel'\ncolumns.{keys}\n"
    (tmp_path / "motor.toml").write_text(f"motor.kind = 'dc'\n{motor}{recording}")
    told = read_recording(path, layout=read_model(tmp_path / "motor.toml").recording)
    np.testing.assert_allclose(told.signals["voltage"], 2.0 * VOLTAGE, atol=1e-6)
    assert told.warnings == ()


def test_a_drive_under_torque_control_is_no_motor_with_a_voltage(tmp_path: Path) -> None:
    """An ODrive exports its torque: a model of kind dc asked for a voltage that there is not."""
    header, columns, _ = EXPORTS["odrive"]
    path = _write(tmp_path / "run.csv", header, columns)
    motor = dict.fromkeys(("resistance", "inductance", "torque_constant", "back_emf_constant", "inertia"), 1.0)
    model = Model(kind="dc", parameters={**motor, "viscous_friction": 1.0}, recording=Layout(profile="odrive"))
    with pytest.raises(InputError, match=r"no 'voltage'.*; or kind = 'axis', if the torque drives$"):
        read_recordings(str(path), model)


def test_two_axes_in_an_export_are_asked_for(tmp_path: Path) -> None:
    header = "time,axis0.vel_estimate,axis1.vel_estimate,axis0.torque_setpoint"
    path = _write(tmp_path / "run.csv", header, [TIME, SPEED / TURN, -SPEED / TURN, TORQUE])
    with pytest.raises(InputError, match=r"axis0.vel_estimate and axis1.vel_estimate may both be the speed.*rename"):
        read_recording(path, layout=Layout(profile="odrive"))
    chosen = {"speed": Column(source="axis1.vel_estimate", unit="turn/s", scale=-1.0)}
    _as_meant(read_recording(path, layout=Layout(profile="odrive", columns=chosen)), ("torque", "speed"))


def test_a_unit_of_the_file_goes_before_the_profile(tmp_path: Path) -> None:
    header = "time [s],Present PWM,Present Velocity [rpm]"
    path = _write(tmp_path / "run.csv", header, [TIME, VOLTAGE / 0.01356, SPEED / RPM])
    _as_meant(read_recording(path, layout=Layout(profile="dynamixel")), ("voltage", "speed"))


def test_names_of_a_tool_are_known_by_two_signals_beside_the_time() -> None:
    assert exporters(["Iq_measured", "vel_estimate", "x"]) == ["odrive"]
    assert exporters(["time", "vel_estimate"]) == []


def test_what_is_no_export_of_the_tool_is_refused(tmp_path: Path) -> None:
    path = _write(tmp_path / "run.csv", "a,b", [TIME, SPEED])
    with pytest.raises(InputError, match="no column is called as in an export of moteus"):
        read_recording(path, layout=Layout(profile="moteus"))
    with pytest.raises(InputError, match=r"unknown profile 'odriv'.*did you mean 'odrive'"):
        Layout(profile="odriv")


def _scope(path: Path, *, separator: str = "\t", comma: bool = False) -> Path:
    """A Scope export as version 3.4 writes it: two channels every 20 ms, one every 40 ms."""
    rows = {
        "Name": ("Name", "Axis 1.ActVelo", "voltage", "Name", "temperature"),
        "SymbolComment": ("SymbolComment", "", "", "SymbolComment", ""),
        "Data-Type": ("Data-Type", "REAL64", "REAL64", "Data-Type", "REAL64"),
        "SampleTime[ms]": ("SampleTime[ms]", "20", "20", "SampleTime[ms]", "40"),
        "SymbolName": ("SymbolName", "Axes.Axis 1.NcToPlc.ActVelo", "MAIN.u", "SymbolName", "MAIN.t"),
        "Unit": ("Unit", "(None)", "V (Voltage)", "Unit", "(None)"),
        "Unit ScaleFactor": ("Unit ScaleFactor", "1", "1", "Unit ScaleFactor", "1"),
    }
    lines = ["Name\trun", "Starttime of export\t132959733843760000\tMontag, 2. Mai 2022\t15:56:24.376", "", ""]
    lines += [separator.join(cells) for cells in rows.values()] + [""]
    for k, (t, w, u) in enumerate(zip(TIME, SPEED, VOLTAGE, strict=True)):
        lines.append(separator.join(f"{x:.12g}" for x in (1e3 * t, w / TURN * 360.0, u, 40.0 * k, 20.0 + k)))
    text = "\n".join([*lines, "EOF", ""])
    path.write_text(text.replace(".", ",") if comma else text)
    return path


@pytest.mark.parametrize(("separator", "comma"), [("\t", False), ("\t", True), (";", True)])
def test_an_export_of_twincat_scope(separator: str, comma: bool, tmp_path: Path) -> None:
    path = _scope(tmp_path / "run.csv", separator=separator, comma=comma)
    speed = Column(source="Axis 1,ActVelo" if comma else "Axis 1.ActVelo", unit="deg/s")
    _as_meant(read_recording(path, layout=Layout(columns={"speed": speed})), ("voltage", "speed"))


SCOPE_KEYS = (
    "Name", "SymbolComment", "Data-Type", "SampleTime[ms]", "VariableSize", "SymbolBased", "IndexGroup", "IndexOffset",
    "SymbolName", "NetID", "Port", "Offset", "ScaleFactor", "BitMask", "Unit", "Unit ScaleFactor", "Unit Offset",
)  # fmt: skip


def _scope_of_pairs(path: Path, *, late: float = 0.0, keys: tuple[str, ...] = SCOPE_KEYS) -> Path:
    """A Scope export in which each channel has times of its own, as pytcs and the DLR's shepard describe it."""
    european = len(keys) > 1
    separator = "\t" if european else ","
    about = {"SampleTime[ms]": ("20", "20"), "Unit": ("V (Voltage)", "(None)"), "Name": ("voltage", "speed")}
    lines = [f"Name{separator}run", f"Starttime of export{separator}133238090039920000", ""]
    for key in keys:
        first, second = about.get(key, ("1", "1"))
        lines.append(separator.join((key, first, key, second)))
    lines.append("")
    for t, u, w in zip(1e3 * TIME, VOLTAGE, SPEED, strict=True):
        cells = [f"{x:.12g}" for x in (t, u, t + late, w)]
        lines.append(separator.join(cell.replace(".", ",") if european else cell for cell in cells))
    path.write_text("\n".join(lines) + "\n")
    return path


@pytest.mark.parametrize("keys", [SCOPE_KEYS, ("Name",)])
def test_an_export_of_twincat_scope_with_times_for_each_channel(keys: tuple[str, ...], tmp_path: Path) -> None:
    path = _scope_of_pairs(tmp_path / "run.csv", keys=keys)
    columns = {"speed": Column(source="speed", unit="rad/s"), "voltage": Column(source="voltage", unit="V")}
    _as_meant(read_recording(path, layout=Layout(columns=columns)), ("voltage", "speed"))


def test_a_channel_of_twincat_scope_at_other_instants_is_not_taken_for_one_of_the_same(tmp_path: Path) -> None:
    path = _scope_of_pairs(tmp_path / "run.csv", late=0.5)
    with pytest.raises(InputError, match=r"speed@\+0\.5ms"):
        read_recording(path, layout=Layout(columns={"speed": Column(source="speed", unit="rad/s")}))


def test_twincat_asks_for_the_unit_of_an_axis_and_for_channels_of_the_same_instants(tmp_path: Path) -> None:
    path = _scope(tmp_path / "run.csv")
    with pytest.raises(InputError, match=r"'Axis 1\.ActVelo' has no unit"):
        read_recording(path, layout=Layout(profile="twincat"))
    with pytest.raises(InputError, match="temperature@40ms"):
        read_recording(path, layout=Layout(columns={"current": Column(source="temperature", unit="A")}))


def test_the_command_line_and_model_files_take_a_profile(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    header, columns, _ = EXPORTS["moteus"]
    _write(tmp_path / "run.csv", header, columns)
    values = {
        "resistance": 0.8, "inductance": 1e-3, "torque_constant": 0.1, "back_emf_constant": 0.1, "inertia": 1e-4,
        "viscous_friction": 1e-5,
    }  # fmt: skip
    motor = "".join(f"motor.{name} = {value}\n" for name, value in values.items())
    (tmp_path / "motor.toml").write_text('motor.kind = "dc"\n' + motor)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "argv", ["rwn", "check", "run.csv", "--model", "motor.toml", "--profile", "moteus"])
    with pytest.raises(SystemExit) as end:
        cli.main()
    assert end.value.code == 0
    assert "voltage, current, speed, position" in capsys.readouterr().out
    (tmp_path / "motor.toml").write_text('recording.profile = "moteus"\nmotor.kind = "dc"\n' + motor)
    model = read_model("motor.toml")
    write_model(model, "again.toml")
    assert read_model("again.toml").recording == model.recording == Layout(profile="moteus")
    (tmp_path / "motor.toml").write_text('recording.profile = "moto"\nmotor.kind = "dc"\n' + motor)
    with pytest.raises(InputError, match=r"\[recording\] profile: unknown profile 'moto'"):
        read_model("motor.toml")


def _profile(*names: str) -> Profile:
    return Profile(source="here", columns={"speed": ProfileColumn(names=names), "time": ProfileColumn(names=("t",))})


def test_a_name_stands_for_itself_and_for_the_end_of_a_longer_one() -> None:
    known = _profile("Vel")
    assert sources(known, ["t", "a.b.vel", "x"], where="x") == {"time": "t", "speed": "a.b.vel"}
    assert sources(known, ["VEL"], where="x") == {"speed": "VEL"}
    assert sources(known, ["level", "a-vel", "vel.a"], where="x") == {}
    assert sources(_profile("vel", "w"), ["w", "a.vel"], where="x") == {"speed": "a.vel"}, "the likeliest first"


def test_a_signal_that_two_columns_may_be_is_asked_for() -> None:
    with pytest.raises(InputError) as refused:
        sources(_profile("vel"), [f"{k}.vel" for k in range(6)], where="run.csv")
    assert refused.value.what == "0.vel and 1.vel and 2.vel and 3.vel may both be the speed"
    assert refused.value.fix == "add to [recording]: rename = { '0.vel' = 'speed' }"
    assert refused.value.where == "run.csv"


def test_a_profile_holds_nothing_but_what_it_may_and_stays_as_it_is() -> None:
    column = {"names": [], "scales": 1.0}
    for wrong in ({"source": "x", "columns": {}, "note": ""}, {"source": "x", "columns": {"speed": column}}):
        with pytest.raises(msgspec.ValidationError):
            msgspec.convert(wrong, Profile)
    known = profile("odrive")
    for frozen, name in ((known, "source"), (known.columns["speed"], "unit")):
        with pytest.raises(AttributeError):
            setattr(frozen, name, "x")


def test_wanted_names_are_whole_or_the_end_of_a_longer_one() -> None:
    wanted = Wanted.of({"Run"}, {"Vel"})
    for name in ("Run", "Vel", "vel", "a.VEL"):
        assert name in wanted
    for other in ("run", "a.Run", "level", 3):
        assert other not in wanted


def test_an_unknown_profile_is_refused_where_it_stands() -> None:
    with pytest.raises(InputError) as refused:
        profile("odriv", where="motor.toml")
    assert refused.value.where == "motor.toml"
    with pytest.raises(InputError, match=r"^profile: unknown profile"):
        profile("x")
