"""Which column is which signal, in which unit, and what is said of those that are none."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.io import savemat

from rwn.errors import InputError
from rwn.recording.columns import column_map, in_si, is_linear, units_of, unused
from rwn.recording.formats import Table, read_table
from rwn.recording.layout import Column, Layout
from rwn.recording.signals import COLUMNS, si_unit

ROWS = np.array([1.0, 2.0, -3.0])


def _table(**units: str | None) -> Table:
    """Columns of the same numbers, with their units; `_` in a name stands for a blank."""
    named = {name.replace("_", " "): unit for name, unit in units.items()}
    return Table(where="run.csv", columns=dict.fromkeys(named, ROWS), units=named)


def _refused(table: Table, layout: Layout) -> InputError:
    with pytest.raises(InputError) as refused:
        column_map(table, layout)
    assert refused.value.where == "run.csv"
    return refused.value


def _map(**columns: Column) -> Layout:
    return Layout(columns=columns)


def test_a_layout_says_nothing_that_was_not_said() -> None:
    told: dict[str, Any] = {
        "columns": {}, "sample_time": None, "initial": "auto", "initial_samples": 20, "intersample": "auto",
        "delays": {}, "filters": {}, "start": None, "end": None, "decimate": 1, "profile": None,
    }  # fmt: skip
    assert Layout() == Layout(**told)
    assert Column(source="x") == Column(source="x", unit=None, scale=1.0, scale_unit="")


def test_signals_are_found_by_name_and_by_the_map() -> None:
    table = _table(time="s", voltage="V", w="rpm", speed="rad/s", note=None)
    assert column_map(table, Layout()) == {n: Column(source=n) for n in ("time", "voltage", "speed")}
    mapped = Column(source="w", scale=2.0)
    assert column_map(table, _map(speed=mapped))["speed"] == mapped


def test_without_any_unit_the_map_alone_counts() -> None:
    """Columns of a matrix may be called like signals and be in whatever unit."""
    table = _table(time=None, speed=None, a=None)
    assert set(column_map(table, Layout())) == {"time", "speed"}
    assert set(column_map(table, _map(speed=Column(source="a", unit="rpm")))) == {"speed"}
    some = _table(time="s", speed=None, a=None)
    assert set(column_map(some, _map(speed=Column(source="a", unit="rpm")))) == {"time", "speed"}


def test_wanted_is_what_may_hold_a_signal() -> None:
    wanted = _map(speed=Column(source="w")).wanted
    assert set(wanted) == {*COLUMNS, "w"}
    by_profile = Layout(profile="odrive", columns={"speed": Column(source="w")}).wanted
    for name in ("w", "time", "odrv0.axis0.Vel_Estimate", "Iq_measured"):
        assert name in by_profile
    assert "estimate" not in by_profile


@pytest.mark.parametrize(
    ("name", "unit", "fix"),
    [
        ("sped", "rpm", "did you mean 'speed'? rename it, or add to [recording]: columns.speed = { source = 'sped' }"),
        ("omega", None, "did you mean 'speed [rad/s]'? add its unit, or add to [recording]: columns.speed = "
                        "{ source = 'omega', unit = 'rad/s' }"),
        ("speed_rpm", None, "write 'speed [rpm]', or add to [recording]: columns.speed = "
                            "{ source = 'speed rpm', unit = 'rpm' }"),
        ("speed_m/s", None, "write 'speed [m/s]', or add to [recording]: columns.speed = "
                             "{ source = 'speed m/s', unit = 'm/s' }"),
        ("rpm", None, "write 'speed [rpm]', or add to [recording]: columns.speed = { source = 'rpm', unit = 'rpm' }"),
        ("Speed_V", None, "did you mean 'speed [rad/s]'? add its unit, or add to [recording]: columns.speed = "
                          "{ source = 'Speed V', unit = 'rad/s' }"),
        ("Voltage", None, "did you mean 'voltage [V]'? add its unit, or add to [recording]: columns.voltage = "
                          "{ source = 'Voltage', unit = 'V' }"),
    ],
)  # fmt: skip
def test_what_is_nearly_called_like_a_signal_is_a_slip(name: str, unit: str | None, fix: str) -> None:
    said = _refused(_table(time="s", **{name: unit}), Layout())
    shown = name.replace("_", " ")
    assert (said.what, said.fix) == (f"column '{shown}' is no known signal", fix)
    assert said.expected == ", ".join(COLUMNS)


def test_all_slips_of_a_file_are_said_at_once() -> None:
    said = _refused(_table(t="s", U="V", w="1/min"), Layout())
    assert said.what == "columns 't', 'U', 'w' are no known signals"
    assert said.fix == (
        "where they are meant so, add to [recording], a line each: columns.time = { source = 't' }; "
        "columns.voltage = { source = 'U' }; columns.speed = { source = 'w' }"
    )


def test_a_slip_beside_the_signal_itself_is_another_column() -> None:
    assert set(column_map(_table(time="s", speed="rpm", omega="rpm"), Layout())) == {"time", "speed"}
    mapped = _map(speed=Column(source="omega"))
    assert column_map(_table(time="s", omega="rpm"), mapped)["speed"].source == "omega"


def test_where_nothing_is_called_like_a_signal_the_map_is_asked_for() -> None:
    said = _refused(_table(a="V", b=None), Layout())
    assert said.what == "no column is called like a signal; there are a, b"
    assert said.fix == 'write for instance: columns.voltage = { source = "a" }'
    several = _refused(_table(PWM="%", Strom="A", Zahl="rpm"), Layout())
    assert "columns.current = { source = \"Strom\" }; columns.speed = { source = \"Zahl\" }" in several.fix
    unknown = _refused(_table(a="s", b=None), Layout())
    assert unknown.fix == 'write for instance: columns.speed = { source = "b", unit = "rad/s" }'
    nothing = _refused(_table(), Layout())
    assert nothing.what == "no column is called like a signal; there are none"
    assert '{ source = "w", unit' in nothing.fix


def test_of_several_runs_in_a_file_one_is_asked_for() -> None:
    names = {"x": None, "slow.run.speed": "rpm", "slow.run.time": "s", "fast.speed": "rpm"}
    table = Table(where="run.csv", columns={}, units=names)
    said = _refused(table, Layout())
    assert said.what == "the file holds several runs: slow.run, fast"
    assert said.fix == "write it after the file: run.csv#slow.run"
    one = Table(where="run.csv", columns={}, units={"x": None, "/drive.speed": "rpm", "/drive.time": "s"})
    said = _refused(one, Layout())
    assert (said.what, said.fix[-14:]) == ("the file holds its signals under one name: /drive", "run.csv#/drive")


def test_a_profile_names_the_columns_that_the_map_does_not() -> None:
    layout = Layout(profile="odrive", columns={"speed": Column(source="mine", unit="rpm")})
    table = Table(where="run.csv", columns={}, units={"mine": None, "a.vel_estimate": None, "Iq_measured": None,
                                                      "pos_estimate": "deg"})  # fmt: skip
    found = column_map(table, layout)
    assert found["speed"] == Column(source="mine", unit="rpm")
    assert found["current"] == Column(source="Iq_measured", unit="A")
    assert found["position"] == Column(source="pos_estimate"), "the unit of the file goes before"


def test_a_sign_in_the_map_goes_on_top_of_what_the_profile_knows() -> None:
    table = Table(where="run.csv", columns={}, units={"vel_estimate": None})
    turned = column_map(table, Layout(profile="odrive", columns={"speed": Column(source="speed", scale=-0.5)}))
    assert turned["speed"] == Column(source="vel_estimate", unit="turn/s", scale=-0.5)
    other = Layout(profile="odrive", columns={"speed": Column(source="speed", unit="rpm", scale=2.0)})
    assert column_map(table, other)["speed"] == Column(source="vel_estimate", unit="rpm", scale=2.0)


def test_a_mapped_column_that_is_not_needed_may_be_missing() -> None:
    table, layout = _table(time="s", voltage="V"), _map(speed=Column(source="w", unit="rpm"))
    assert set(column_map(table, layout, needed=("time", "voltage"))) == {"time", "voltage"}
    assert "speed" in column_map(table, layout)


def test_what_is_no_export_of_the_tool_says_what_one_has() -> None:
    said = _refused(_table(a=None, b=None), Layout(profile="sysid"))
    assert said.what == "no column is called as in an export of sysid; there are a, b"
    assert said.expected.startswith("one of ")
    assert {"voltage", "velocity"} <= {*said.expected.removeprefix("one of ").split(", ")}
    assert "there are none" in _refused(_table(), Layout(profile="sysid")).what
    mapped = Layout(profile="sysid", columns={"speed": Column(source="a", unit="rpm")})
    assert set(column_map(_table(a=None), mapped)) == {"speed"}


@pytest.mark.parametrize(
    ("count", "shown"),
    [(0, None), (1, "a0"), (8, ", ".join(f"a{k}" for k in range(8))),
     (19, ", ".join(f"a{k}" for k in range(8)) + " and 11 more")],
)  # fmt: skip
def test_what_is_not_used_is_said_a_few_by_name(count: int, shown: str | None) -> None:
    table = _table(speed="rpm", **{f"a{k}": "V" for k in range(count)})
    said = unused(table, {"speed": Column(source="speed")})
    assert said == (() if shown is None else (f"run.csv: not used: {shown}",))


def test_a_long_name_is_cut_where_it_is_shown() -> None:
    (said,) = unused(_table(**{"x" * 41: "V"}), {})
    assert said == f"run.csv: not used: {'x' * 40} .."
    assert unused(_table(**{"x" * 40: "V"}), {}) == (f"run.csv: not used: {'x' * 40}",)


@pytest.mark.parametrize(
    ("units", "linear"),
    [
        ({"position": "mm", "speed": "rpm"}, True),
        ({"position": "deg", "force": "N"}, False),
        ({"speed": "mm/s"}, True),
        ({"speed": "rpm", "force": "N"}, False),
        ({"force": "N"}, True),
        ({"torque": "N m"}, False),
    ],
)
def test_position_then_speed_then_a_force_say_whether_an_axis_is_linear(units: dict[str, str], linear: bool) -> None:
    assert is_linear(_table(**units), {name: Column(source=name) for name in units}) is linear


def test_numbers_are_scaled_into_si() -> None:
    table = _table(w="rpm", u="V")
    np.testing.assert_allclose(in_si(table, "speed", Column(source="w", scale=-2.0), linear=False),
                               -2.0 * ROWS * np.pi / 30.0)  # fmt: skip
    force = Column(source="u", scale=3.0, scale_unit="kN/V")
    np.testing.assert_allclose(in_si(table, "force", force, linear=True), 3e3 * ROWS)
    assert units_of(table, {"speed": Column(source="w"), "force": force}) == {"speed": "rpm"}


def test_a_map_and_a_header_that_disagree_are_refused() -> None:
    table = _table(w="rpm", x=None)
    for unit in ("rpm", "1/min"):
        assert np.all(in_si(table, "speed", Column(source="w", unit=unit), linear=False) == ROWS * np.pi / 30.0)
    with pytest.raises(InputError, match=re.escape("column 'w': the column is in [rpm], the map says 'deg/s'")):
        in_si(table, "speed", Column(source="w", unit="deg/s"), linear=False)
    said = "column 'x' has no unit; expected name [unit]; fix: write 'x [rad/s]', 'x [rpm]' or"
    with pytest.raises(InputError, match=re.escape(said)):
        in_si(table, "speed", Column(source="x"), linear=False)


@pytest.mark.parametrize(("source", "fix"), [("volts", "did you mean 'volt'?"), ("q", "correct [recording.columns]")])
def test_a_column_that_there_is_not_is_said(source: str, fix: str) -> None:
    with pytest.raises(InputError) as refused:
        in_si(_table(volt="V", b="A"), "voltage", Column(source=source), linear=False)
    assert refused.value.what == f"there is no column '{source}' (mapped to voltage)"
    assert (refused.value.expected, refused.value.fix) == ("one of volt, b", fix)


@pytest.mark.parametrize("name", COLUMNS)
def test_each_signal_has_its_si_unit_on_a_shaft_and_on_a_line(name: str) -> None:
    signal = COLUMNS[name]
    assert si_unit(signal, True) == (signal.linear_unit or signal.unit) != ""
    assert si_unit(signal, False) == (signal.unit or signal.linear_unit) != ""


@pytest.mark.parametrize(
    ("variable", "sources", "left"),
    [
        ({"w": ROWS, "u": ROWS, "t": ROWS}, ("log.w", "log.u"), "log.t"),  # which are `w`, `u`, `t` as well
        ({"w": ROWS, "u": ROWS, "t": ROWS}, ("w", "u"), "log.t"),
        (np.column_stack([ROWS, ROWS, ROWS]), ("log(:,1)", "log(:,2)"), "log(:,3)"),
        ({"m": np.column_stack([ROWS, ROWS])}, ("log.m(:,1)",), "log.m(:,2)"),
        ({"m": np.column_stack([ROWS, ROWS])}, ("m(:,2)",), "log.m(:,1)"),
        ({"w": ROWS}, ("w",), None),
    ],
)
def test_what_is_used_by_one_of_its_names_is_not_unused_by_another(
    variable: Any, sources: tuple[str, ...], left: str | None, tmp_path: Path
) -> None:
    path = tmp_path / "a.mat"
    savemat(path, {"log": variable})
    mapping = {str(k): Column(source=name) for k, name in enumerate(sources)}
    assert unused(read_table(path, sources), mapping) == ((f"{path}: not used: {left}",) if left else ())


def test_nor_is_what_a_part_of_the_file_holds(tmp_path: Path) -> None:
    path = tmp_path / "a.mat"
    savemat(path, {"log": {"m": np.column_stack([ROWS, ROWS]), "w": ROWS}, "other": ROWS})
    table = read_table(Path(f"{path}#log"), ("w", "m(:,2)"))
    mapping = {"speed": Column(source="w"), "voltage": Column(source="m(:,2)")}
    assert unused(table, mapping) == (f"{path}#log: not used: m(:,1)",)


def test_a_column_that_is_taken_for_a_signal_is_no_other_by_its_name() -> None:
    """The current that stands for the torque of an axis was taken as measured too, and cut where it is at its limit."""
    table = _table(time="s", current="A", speed="rad/s")
    mapping = column_map(table, _map(torque=Column(source="current", unit="A", scale=1.9, scale_unit="N m/A")))
    assert {name: column.source for name, column in mapping.items()} == {
        "time": "time", "speed": "speed", "torque": "current"
    }  # fmt: skip
