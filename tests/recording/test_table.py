"""Arrays, channels and what is nested, as the columns of a table."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from rwn.errors import InputError
from rwn.recording.formats import table as table_module
from rwn.recording.formats.channels import Channel, table_of_channels
from rwn.recording.formats.frame import name_and_unit_of
from rwn.recording.formats.nested import nested_table
from rwn.recording.formats.table import Table, table_of, too_long, vector

ROWS = np.array([1.0, 2.0, 4.0])


def _names(content: dict[str, Any], names: tuple[str, ...] | None = None) -> list[str]:
    """What is found in two variables, of which the second is a number."""
    return list(nested_table("x", {**content, "n": 1.0}, names or (*content, "n"), ()).units)


class _Unit:
    """As pint's, in the attributes of an xarray.Dataset."""

    def __str__(self) -> str:
        return "rad/s"


def test_a_unit_that_is_an_object_is_what_it_is_written_as() -> None:
    made = table_of("x", {"speed": ROWS, "time": ROWS}, {"speed": _Unit()}, {"speed"})
    assert made.units == {"speed": "rad/s", "time": None}


@pytest.mark.parametrize(
    ("values", "seconds"),
    [
        (np.array([3, 5], dtype="datetime64[ms]"), [0.0, 2e-3]),
        (np.array([3, 5], dtype="timedelta64[ms]"), [3e-3, 5e-3]),
        (np.array([[1], [2]]), [1.0, 2.0]),
        (np.array([[1, 2]]), [1.0, 2.0]),
        (np.array(7), [7.0]),
        ([True, False], [1.0, 0.0]),
        (np.array([1, 2], dtype=np.uint8), [1.0, 2.0]),
    ],
)
def test_a_column_is_a_vector_of_real_numbers(values: Any, seconds: list[float]) -> None:
    made = vector("x", "t", values)
    assert made.dtype == np.float64
    assert made.flags.c_contiguous
    np.testing.assert_allclose(made, seconds, rtol=1e-12)


@pytest.mark.parametrize(
    ("values", "what", "fix"),
    [
        (["a"], "'t' does not hold real numbers", "name a column of numbers, such as RawData.Velo in a struct"),
        (np.array([], dtype="datetime64[ms]"), "'t' does not hold real numbers",
         "name a column of numbers, such as RawData.Velo in a struct"),
        ([1j], "'t' does not hold real numbers", "name a column of numbers, such as RawData.Velo in a struct"),
        (np.ones((3, 2)), "'t' has shape (3, 2)", "name one of its columns: 't(:,1)'"),
        (np.ones((3, 2, 2)), "'t' has shape (3, 2, 2)", "save each signal as a vector"),
    ],
)  # fmt: skip
def test_what_is_none_is_refused(values: Any, what: str, fix: str) -> None:
    with pytest.raises(InputError) as refused:
        vector("run.mat", "t", values)
    assert (refused.value.what, refused.value.where, refused.value.fix) == (what, "run.mat", fix)


def test_a_recording_may_have_twenty_million_samples(monkeypatch: pytest.MonkeyPatch) -> None:
    assert "at most 20000000 samples" in str(too_long("x", 20_000_001))
    monkeypatch.setattr(table_module, "MAX_SAMPLES", 3)
    assert vector("x", "t", ROWS).size == 3
    with pytest.raises(InputError, match="4 samples are too many"):
        vector("x", "t", np.ones(4))


def test_all_columns_are_named_and_the_wanted_ones_held() -> None:
    made = table_of("x", {"a": ROWS, "b": ["no number"] * 3}, {"a": "V"}, {"a", "c"})
    assert list(made.columns) == ["a"]
    assert made.units == {"a": "V", "b": None}
    assert Table(where="x", columns={}, units={}).row(0) == "sample 1"


def _channels(**of: tuple[list[float], list[float]]) -> dict[str, list[float]]:
    made = {name: Channel(np.array(at), np.array(values)) for name, (at, values) in of.items()}
    table = table_of_channels("x", made, dict.fromkeys(made, "V"), {*made} - {"other"})
    return {name: x.tolist() for name, x in table.columns.items()}


def test_channels_of_the_same_instants_stay_as_they_are() -> None:
    at = [0.0, 1.0, 2.0]
    assert _channels(u=(at, [1.0, 2.0, 3.0]), w=(at, [4.0, 5.0, 6.0])) == {
        "time": at, "u": [1.0, 2.0, 3.0], "w": [4.0, 5.0, 6.0],
    }  # fmt: skip


def test_a_channel_is_held_on_the_rows_of_the_one_logged_most_often() -> None:
    rows = [0.0, 1.0, 2.0, 3.0]
    found = _channels(u=([0.5, 2.0], [7.0, 8.0]), w=(rows, [1.0, 2.0, 3.0, 4.0]))
    assert found == {"time": [1.0, 2.0, 3.0], "u": [7.0, 8.0, 8.0], "w": [2.0, 3.0, 4.0]}
    begun = _channels(u=([1.0], [7.0]), w=(rows, [1.0, 2.0, 3.0, 4.0]))
    assert begun["time"] == [1.0, 2.0, 3.0], "from the instant on at which all have a value"


def test_of_rows_that_repeat_an_instant_the_last_is_kept() -> None:
    found = _channels(w=([0.0, 1.0, 1.0, 2.0, 2.0], [1.0, 2.0, 3.0, 4.0, 5.0]))
    assert found == {"time": [0.0, 1.0, 2.0], "w": [1.0, 3.0, 5.0]}


def test_a_channel_without_a_value_leaves_no_row() -> None:
    assert _channels(u=([], []), w=([0.0, 1.0], [1.0, 2.0])) == {"time": [], "u": [], "w": []}


def test_a_time_among_the_channels_is_not_that_of_the_rows() -> None:
    told = {"time": "h", "u": "V", "note": None}
    made = {"time": Channel(ROWS, 9.0 * ROWS), "u": Channel(ROWS, ROWS), "x": Channel(9.0 * ROWS, ROWS)}
    table = table_of_channels("run", made, told, {"time", "u"})
    assert table.columns["time"].tolist() == table.columns["u"].tolist() == ROWS.tolist()
    assert dict(table.units) == {"time": "s", "u": "V", "note": None}
    nothing = table_of_channels("run", made, told, {"time"})
    assert (dict(nothing.columns), dict(nothing.units), nothing.where) == ({}, {"u": "V", "note": None}, "run")


def test_too_many_rows_of_channels_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(table_module, "MAX_SAMPLES", 3)
    assert _channels(u=([0.0, 1.0, 2.0], [1.0] * 3))["time"] == [0.0, 1.0, 2.0]
    with pytest.raises(InputError, match="4 samples are too many"):
        _channels(u=([0.0, 1.0, 2.0, 3.0], [1.0] * 4))


def test_fields_of_structs_and_columns_of_matrices_have_names() -> None:
    plain = np.zeros(3, dtype=[("u", float), ("w", float)])
    one = np.empty((1, 1), dtype=[("u", object)])
    one[0, 0] = (ROWS,)
    two = np.empty((1, 2), dtype=[("u", object)])
    two[0, 0], two[0, 1] = (ROWS,), (ROWS,)
    cells = np.empty(2, dtype=object)
    cells[:] = [ROWS, 2.0 * ROWS]
    cell = np.empty(1, dtype=object)
    cell[0] = ROWS
    assert _names({"a": plain}) == ["a.u", "a.w", "n"]
    assert _names({"a": one}) == ["a.u", "n"]
    assert _names({"a": two}) == ["a(1).u", "a(2).u", "n"]
    assert _names({"a": cells}) == ["a{1}", "a{2}", "n"]
    assert _names({"a": cell}) == ["a", "n"]
    assert _names({"a": np.ones((4, 2))}) == ["a", "a(:,1)", "a(:,2)", "n"]
    for vectors in (np.ones((4, 1)), np.ones((1, 4)), np.ones(4), np.ones((2, 2, 2))):
        assert _names({"a": vectors}) == ["a", "n"]


def test_the_values_are_those_of_the_name() -> None:
    cells = np.empty(2, dtype=object)
    cells[:] = [ROWS, 2.0 * ROWS]
    content = {"c": cells, "M": np.column_stack([ROWS, 3.0 * ROWS])}
    wanted = ("c{2}", "M(:,1)", "M(:,2)")
    read = nested_table("x", content, ("c", "M"), wanted).columns
    assert {name: x.tolist() for name, x in read.items()} == {
        "c{2}": [2.0, 4.0, 8.0], "M(:,1)": [1.0, 2.0, 4.0], "M(:,2)": [3.0, 6.0, 12.0],
    }  # fmt: skip


@pytest.mark.parametrize(("columns", "found"), [(200, 201), (201, 1)])
def test_a_matrix_of_many_columns_is_no_table_of_signals(columns: int, found: int) -> None:
    assert len(_names({"a": np.ones((2, columns))})) == found + 1


def test_of_many_structs_the_first_are_named() -> None:
    cells = np.empty(205, dtype=object)
    cells[:] = [1.0] * 205
    assert len(_names({"a": cells})) == 200 + 1
    structs = np.empty(205, dtype=[("u", object)])
    structs["u"] = cells
    assert len(_names({"a": structs})) == 200 + 1


def test_nesting_ends_somewhere() -> None:
    """Eight levels, the array at the end among them."""

    def nested(levels: int) -> Any:
        value: Any = ROWS
        for _ in range(levels):
            outer = np.empty(1, dtype=[("a", object)])
            outer[0] = (value,)
            value = outer
        return value

    def in_cells(levels: int) -> Any:
        value: Any = ROWS
        for _ in range(levels):
            outer = np.empty(2, dtype=object)
            outer[:] = [value, 1.0]
            value = outer
        return value

    assert _names({"c": in_cells(7)})[0] == "c" + "{1}" * 7
    assert "c" + "{1}" * 8 not in _names({"c": in_cells(8)})
    assert _names({"s": nested(7)}) == ["s" + ".a" * 7, "n"]
    assert _names({"s": nested(8)}) == ["n"]


def test_what_is_in_the_only_variable_has_its_own_name_as_well() -> None:
    plain = np.zeros(3, dtype=[("u", float), ("w", float)])
    plain["u"] = ROWS
    alone = nested_table("x", {"log": plain}, ("log",), ("u",))
    assert list(alone.units) == ["log.u", "log.w", "u", "w"]
    assert alone.columns["u"].tolist() == ROWS.tolist()
    assert list(nested_table("x", {"M": np.ones((3, 2))}, ("M",), ()).units) == ["M", "M(:,1)", "M(:,2)"]
    several = nested_table("x", {"log": plain}, ("log", "other"), ("u",))
    assert list(several.units) == ["other", "log.u", "log.w"], "what was not read is named too"
    assert dict(nested_table("x", {}, ("log",), ()).units) == {"log": None}


def test_an_object_with_properties_is_read_by_them() -> None:
    class Timetable:
        properties = {"u": ROWS, "inner": np.column_stack([ROWS, ROWS])}  # noqa: RUF012  # as matio has them

    assert _names({"a": Timetable()}) == ["a.u", "a.inner", "a.inner(:,1)", "a.inner(:,2)", "n"]


@pytest.mark.parametrize(
    ("column", "told"),
    [("speed [rpm]", ("speed", "rpm")), ("speed", ("speed", None)), ("speed [rpm", ("speed [rpm", None))],
)
def test_a_column_of_open_brackets_is_a_name_as_it_is(column: str, told: tuple[str, str | None]) -> None:
    assert name_and_unit_of(column) == told
