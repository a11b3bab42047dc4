"""The block of names above the numbers of a TwinCAT Scope export."""

from __future__ import annotations

import pytest

from rwn.recording.formats.scope import Block, scope_block

STARTED = "Starttime of export\t132959733843760000"


def _block(*rows: str, first: str = "0\t1\t2\t3\t4\t5", above: tuple[str, ...] = (STARTED,)) -> Block:
    found = scope_block([*above, *(row.replace(" | ", "\t") for row in rows), "", first])
    assert found is not None
    return found


def test_a_file_without_the_block_is_none_of_scope() -> None:
    assert scope_block([]) is None
    assert scope_block(["time [s],speed [rpm]", "0,1"]) is None
    assert scope_block(["Name\tspeed", "Unit\tV"]) is None, "neither sample times nor the time of the export"
    late = ["#"] * 57
    assert scope_block([*late, STARTED, "Name\tu", "Unit\tV", "", "0\t1"]) is not None
    assert scope_block([*late, "#", STARTED, "#", "Name\tu", "Unit\tV", "", "0\t1"]) is None, "beyond 60 lines"


def test_names_units_and_the_first_row_of_numbers() -> None:
    found = _block("Name | a | b | c", "SampleTime[ms] | 2 | 2 | 2", "Unit | V (Voltage) | (None) | (deg/s)",
                   "Unit ScaleFactor | 1 | 1 | 1")  # fmt: skip
    assert found == Block("\t", ("time", "a", "b", "c"), ("ms", "V", None, "deg/s"), 6)
    assert _block("SampleTime[ms] | 2", "Unit | V", "Name | a").first == 5, "keys in any order"
    assert scope_block([STARTED, "Name\ta"]) == Block("\t", ("time", "a"), ("ms", None), 2), "no numbers yet"


@pytest.mark.parametrize(
    ("cell", "unit"),
    [("V (Voltage)", "V"), ("(None)", None), ("(deg/s)", "deg/s"), ("N m", "N m"), ("N m (Torque)", "N m"), ("", None)],
)
def test_a_unit_stands_before_what_it_is_of(cell: str, unit: str | None) -> None:
    assert _block("Name | a", "SampleTime[ms] | 2", f"Unit | {cell}").units == ("ms", unit)


def test_a_block_without_units_ends_where_numbers_begin() -> None:
    found = _block("Name | a | b", "SampleTime[ms] | 2 | 2", "SymbolName | x.a | x.b", "BitMask | 0xFFFF | 0xFFFF")
    assert found == Block("\t", ("time", "a", "b"), ("ms", None, None), 6)


def test_cells_that_no_name_stands_above_are_left_out() -> None:
    for rows in (
        ("Name | a", "SampleTime[ms] | 2 | 2", "Unit | V | A"),
        ("Name | a | b", "SampleTime[ms] | 2", "Unit | V | A"),
        ("Name | a | b", "SampleTime[ms] | 2 | 2", "Unit | V"),
    ):
        assert _block(*rows).names == ("time", "a")


@pytest.mark.parametrize("separator", ["\t", ";", ","])
def test_the_delimiter_is_that_of_the_block(separator: str) -> None:
    rows = ("Name | a | b", "SampleTime[ms] | 2 | 2", "Unit | V | A")
    lines = [STARTED, *(row.replace(" | ", separator) for row in rows), "", "0"]
    found = scope_block(lines)
    assert found is not None
    assert (found.delimiter, found.names) == (separator, ("time", "a", "b"))
    plainest = scope_block(["Starttime of export\t1", f"Starttime of export{separator}1", f"Name{separator}a", "0"])
    assert plainest is not None
    assert (plainest.delimiter, plainest.names) == (separator, ("time", "a"))


def test_groups_of_the_same_instants_have_times_by_their_column() -> None:
    """The third group begins in column 5 of the file."""
    found = _block("Name | a | Name | b | Name | c", "SampleTime[ms] | 2 | x | 2 | x | 2",
                   "Unit | V | Unit | V | Unit | V", first="7\t1\t7\t1\t7\t1")  # fmt: skip
    assert found.names == ("time", "a", "time@3", "b", "time@5", "c")
    assert found.units == ("ms", "V", "ms", "V", "ms", "V")


@pytest.mark.parametrize(
    ("first", "names"),
    [
        ("7\t1\t7,5\t1", ("time", "a", "time@+0.5ms", "b@+0.5ms")),
        ("7.25\t1\t7\t1", ("time", "a", "time@-0.25ms", "b@-0.25ms")),
        ("7\t1", ("time", "a", "time@-7ms", "b@-7ms")),
        ("x\t1\tx\t1", ("time", "a", "time@3", "b")),
    ],
)
def test_a_group_that_begins_later_says_by_how_much(first: str, names: tuple[str, ...]) -> None:
    rows = ("Name | a | Name | b", "SampleTime[ms] | 2 | x | 2", "Unit | V | Unit | V")
    assert _block(*rows, first=first).names == names


@pytest.mark.parametrize("step", ["1", "5", "40"])
def test_a_group_of_another_sample_time_is_called_by_it(step: str) -> None:
    found = _block("Name | a | b | Name | c", f"SampleTime[ms] | 2 | 2 | x | {step}", "Unit | V | V | Unit | A")
    assert found.names == ("time", "a", "b", f"time@{step}ms", f"c@{step}ms")
    found = _block("Name | c | Name | a | b", f"SampleTime[ms] | {step} | x | 2 | 2", "Unit | A | Unit | V | V")
    assert found.names == (f"time@{step}ms", f"c@{step}ms", "time", "a", "b"), "most channels, not the first"
