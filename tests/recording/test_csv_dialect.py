"""How a CSV is written, told from its first lines: encoding, separator, and which rows hold names and units."""

from __future__ import annotations

import pytest

from rwn.errors import InputError
from rwn.recording.formats.csv_cells import is_number, name_and_unit, split
from rwn.recording.formats.csv_dialect import Dialect, dialect_of, encoding_of

WANTED = {"time", "voltage", "speed"}


def rows(delimiter: str = ",", count: int = 20, end: str = "") -> list[str]:
    return [delimiter.join((f"{k / 10}", f"{k}.5", f"-{k}")) + end for k in range(count)]


def told(*lines: str, wanted: set[str] = WANTED) -> Dialect:
    return dialect_of(lines, wanted, "x.csv")


@pytest.mark.parametrize(
    ("start", "encoding"),
    [
        (b"time,speed\n", "utf-8"),
        (b"", "utf-8"),
        (b"\xef\xbb\xbftime", "utf-8-sig"),
        ("time".encode("utf-16"), "utf-16"),
        (b"\xfe\xff" + "time".encode("utf-16-be"), "utf-16"),
        ("time,speed".encode("utf-16-le"), "utf-16-le"),
        ("time,speed".encode("utf-16-be"), "utf-16-be"),
        ("time °".encode("cp1252"), "utf-8"),
    ],
)
def test_the_encoding_is_told_from_marks_and_zeros(start: bytes, encoding: str) -> None:
    assert encoding_of(start, "x.csv") == encoding


@pytest.mark.parametrize("start", [b"\0\0\0\0", b"time\0speed", b"\0a\0bc\0d\0ef", b"PK\3\4\0\0\0\0"])
def test_bytes_are_no_text(start: bytes) -> None:
    with pytest.raises(InputError, match="not a text file"):
        encoding_of(start, "x.csv")


@pytest.mark.parametrize(
    ("cell", "name", "unit"),
    [
        ("speed", "speed", None),
        ("speed [rpm]", "speed", "rpm"),
        (" speed[rpm] ", "speed", "rpm"),
        ("speed [ 1/min ]", "speed", "1/min"),
        ("speed []", "speed", None),
        ("speed (rad/s)", "speed", "rad/s"),
        ("motor speed (rpm)", "motor speed", "rpm"),
        ("f(x) (V)", "f(x)", "V"),
        ("speed / rpm", "speed", "rpm"),
        ("speed in rpm", "speed", "rpm"),
        ("margin", "margin", None),
        ("u/i", "u/i", None),
        ("r0061[0]", "r0061[0]", None),
        ("[V]", "", "V"),
        ("", "", None),
        ("x" * 301 + " [V]", "x" * 301 + " [V]", None),
        ("x" * 296 + " [V]", "x" * 296, "V"),
    ],
)
def test_a_cell_is_a_name_with_its_unit(cell: str, name: str, unit: str | None) -> None:
    assert name_and_unit(cell) == (name, unit)


@pytest.mark.parametrize("cell", ["speed [rpm", "speed rpm]", "speed [a] [b] ["])
def test_brackets_that_are_left_open_are_no_unit(cell: str) -> None:
    with pytest.raises(ValueError, match="speed"):
        name_and_unit(cell)
    with pytest.raises(InputError, match=r"x.csv, line 1: cannot read the column name"):
        told(f"time,{cell},voltage", *rows())


NUMBERS = ("1", "-1.5e3", "+.5", "1,5", "2.", "1E-7", " 3 ", "nan", "-Infinity", "INF")


@pytest.mark.parametrize(
    ("cell", "number"), [*((n, True) for n in NUMBERS), *((n, False) for n in ("", "x", "1 0", "."))]
)
def test_what_a_number_looks_like(cell: str, number: bool) -> None:
    assert is_number(cell) == number


@pytest.mark.parametrize("delimiter", [",", ";", "\t", "|"])
def test_the_separator_is_what_tells_numbers_apart(delimiter: str) -> None:
    found = told(delimiter.join(("time [s]", "voltage [V]", "speed [rpm]")), *rows(delimiter))
    assert found == Dialect(delimiter=delimiter, names=("time", "voltage", "speed"), units=("s", "V", "rpm"), first=1)


def test_a_comma_within_a_unit_or_a_number_separates_nothing() -> None:
    assert told("time [s];speed [x,y]", *[f"{k},5;{k},25" for k in range(20)]).delimiter == ";"
    assert told("time [s],speed [a;b;c]", *[f"{k},{k}" for k in range(20)]).delimiter == ","


def test_quotes_hide_separators() -> None:
    found = told('"time [s]","speed [rpm]","said"', *[f'"{k}","{k}.5","on, off; on"' for k in range(20)])
    assert (found.delimiter, found.names) == (",", ("time", "speed", "said"))
    assert split('"a;b";c', ";", "x.csv") == ["a;b", "c"]


@pytest.mark.parametrize(
    ("above", "units", "first"),
    [
        (["time,voltage,speed", "s,V,rpm"], ("s", "V", "rpm"), 2),
        (["s,V,rpm", "time,voltage,speed"], (None, None, None), 2),
        (["time,voltage,speed", "[s],(V),[rpm]"], ("s", "V", "rpm"), 2),
        (["time [s],voltage,speed", "s,V,"], ("s", "V", None), 2),
        (["time,voltage,speed", "s,V,rpm", "double,double,double"], ("s", "V", "rpm"), 3),
        (["bench 3, night", "", "# time,voltage,speed", "# s,V,rpm"], ("s", "V", "rpm"), 4),
        (["time,voltage,speed", "# begun at noon"], (None, None, None), 2),
        (["a,b,c", "time,voltage,speed"], (None, None, None), 2),
        (["time,voltage,speed,", "s,V,rpm,"], ("s", "V", "rpm"), 2),
    ],
)
def test_the_row_of_names_and_that_of_units(above: list[str], units: tuple[str | None, ...], first: int) -> None:
    found = told(*above, *rows())
    assert found.names == ("time", "voltage", "speed")
    assert found.units == units
    assert found.first == first


def test_of_rows_that_are_all_unknown_the_topmost_that_is_no_unit_names() -> None:
    assert told("alpha,beta,gamma", "s,V,rpm", *rows()).names == ("alpha", "beta", "gamma")
    assert told("s,V,rpm", "alpha,beta,gamma", *rows()).names == ("alpha", "beta", "gamma")
    assert told("alpha,beta,gamma", "delta,eps,zeta", *rows()).names == ("alpha", "beta", "gamma")


def test_a_column_without_a_name_is_called_by_its_place() -> None:
    assert told("time [s],,speed [rpm]", *rows()).names == ("time", "column 2", "speed")


def test_columns_of_text_do_not_hide_those_of_numbers() -> None:
    found = told("time,state,speed", *[f"{k},on,{k}.5" for k in range(20)])
    assert (found.names, found.first) == (("time", "state", "speed"), 1)


def test_only_names_without_numbers_are_read_for_the_refusal_that_follows() -> None:
    found = told("# note", "time [s],speed [rpm]", "a,b", "c,d")
    assert found == Dialect(delimiter=",", names=("time", "speed"), units=("s", "rpm"), first=2)


def test_a_header_that_no_number_follows_is_refused_by_its_line() -> None:
    with pytest.raises(InputError, match=r"x.csv, line 2: cannot read the column name 'speed \[rpm'"):
        told("# note", "time [s],speed [rpm", "a,b", "c,d")


def test_columns_are_called_by_number_where_the_map_does() -> None:
    found = told(*rows(), wanted={"3"})
    assert found == Dialect(delimiter=",", names=("1", "2", "3"), units=(None, None, None), first=0)
    with pytest.raises(InputError, match=r"line 1: no row names the columns: the first row of numbers begins with 0.0"):
        told(*rows(), wanted={"4"})


@pytest.mark.parametrize(
    ("header", "line", "what"),
    [
        ("time,speed", "1,5,2,5", "4 values in 2 columns: decimal commas"),
        ("time,voltage,speed", "1,1,5,2,5", "5 values in 3 columns: decimal commas"),
        ("time,voltage", "1,2,3", "3 values in 2 columns; expected one value for each of time, voltage"),
        ("time,voltage", "1,2,3,4,5", "5 values in 2 columns; expected one value for each"),
        ("alpha,beta", "1;2;3", "no row names the columns"),
        ("time;speed", "1;2;3;4", "4 values in 2 columns; expected one value for each of time, speed"),
    ],
)
def test_a_header_that_does_not_fit_the_rows(header: str, line: str, what: str) -> None:
    with pytest.raises(InputError) as refused:
        told(header, *[line] * 20)
    assert f"x.csv, line 2: {what}" in str(refused.value)


@pytest.mark.parametrize("lines", [[], [""], ["", " ;;, # "]])
def test_a_file_without_anything_is_empty(lines: list[str]) -> None:
    with pytest.raises(InputError, match="the file is empty"):
        told(*lines)


def test_a_line_that_no_reader_splits_is_refused() -> None:
    with pytest.raises(InputError, match="cannot be split into cells"):
        split('"' + "x" * 200_000 + '"', ",", "x.csv")


@pytest.mark.parametrize(
    ("odd", "even", "encoding"),
    [(85, 5, "utf-16-le"), (5, 85, "utf-16-be"), (75, 0, None), (0, 75, None), (85, 15, None), (15, 85, None)],
)
def test_a_text_of_two_bytes_a_sign_has_zeros_in_one_of_them(odd: int, even: int, encoding: str | None) -> None:
    """In 100 pairs; signs of other scripts, and of the line's end, keep some of them from being 0."""
    start = b"".join(bytes([0 if k < even else 65, 0 if k < odd else 65]) for k in range(100))
    if encoding is None:
        with pytest.raises(InputError, match="not a text file"):
            encoding_of(start, "x.csv")
    else:
        assert encoding_of(start, "x.csv") == encoding
    assert encoding_of(b"A", "x.csv") == "utf-8"


@pytest.mark.parametrize("count", [1, 2, 3, 4])
def test_names_may_stand_up_to_four_rows_above_the_numbers(count: int) -> None:
    above = ["time,voltage,speed", *["alpha,beta,gamma"] * (count - 1)]
    assert told(*above, *rows()).names == ("time", "voltage", "speed")
    assert told(*above, *rows()).first == count


def test_rows_farther_above_are_not_names() -> None:
    assert told("time,voltage,speed", *["alpha,beta,gamma"] * 4, *rows()).names == ("alpha", "beta", "gamma")


def test_a_row_of_another_width_ends_the_rows_of_names() -> None:
    found = told("time,voltage,speed", "bench,3", "alpha,beta,gamma", *rows())
    assert found.names == ("alpha", "beta", "gamma")
    assert told("time,voltage,speed", "# bench,3", "alpha,beta,gamma", *rows()).names == ("time", "voltage", "speed")
    assert told("time,voltage,speed,", *rows()).names == ("time", "voltage", "speed")
    with pytest.raises(InputError, match="no row names the columns"):
        told("alpha,beta,gamma,delta", *rows())


def test_units_are_short() -> None:
    """A cell of 30 signs is no unit, however it reads."""
    long, short = "m" + "*m" * 15, "m" + "*m" * 14
    assert (len(long), len(short)) == (31, 29)
    assert told("s,V,rpm", f"{short},{short},{short}", *rows()).names == ("s", "V", "rpm"), "both are units"
    assert told("s,V,rpm", f"{long},{long},{long}", *rows()).names == (long, long, long)
    edge = short + " "
    assert told("s,V,rpm", f"a{edge},{edge},b", *rows()).names[0] == f"a{short}"


BAD = ["1,2,x", "0,OL,OL", "0,,", ",,3", "0.1 s,1 V,2 rpm", "1,2", "1,2,3,4", "2024-01-01,x,y"]


@pytest.mark.parametrize("row", BAD)
def test_a_row_below_the_names_that_begins_as_numbers_do_is_data(row: str) -> None:
    """What is wrong with it is said when it is read; none is passed over."""
    assert told("time,voltage,speed", row, *rows()).first == 1
    assert told("time,voltage,speed", "s,V,rpm", row, *rows()).first == 2


@pytest.mark.parametrize("head", ["time,voltage,speed", "alpha,beta,gamma", ""])
def test_rows_of_no_numbers_but_nan_are_data_too(head: str) -> None:
    found = told(*filter(None, [head]), *["nan,nan,inf"] * 20, wanted=WANTED if head else {"1"})
    assert found.first == bool(head)
    assert found.names == (tuple(head.split(",")) if head else ("1", "2", "3"))


@pytest.mark.parametrize("row", ["s,V,1/min", "s,V,1", "double,double,double", "clock,motor,motor"])
def test_a_row_of_units_or_words_is_none(row: str) -> None:
    assert told("time,voltage,speed", row, *rows()).first == 2


def test_rows_are_judged_by_the_end_of_the_sample() -> None:
    """Keys and values above may outnumber a few rows; half of the lines from the end tell how rows look."""
    keys = [f"key {k};{k}" for k in range(9)]
    found = told(*keys, "time,voltage,speed", *rows(count=12))
    assert (found.delimiter, found.names, found.first) == (",", ("time", "voltage", "speed"), 10)


@pytest.mark.parametrize(
    ("lines", "delimiter"),
    [
        (["time;speed", *[f"{k},5;{k},25" for k in range(20)]], ";"),
        (["time,speed", *[f"{k},{k}" for k in range(20)]], ","),
        (["time\tspeed,x", *[f"{k}\t{k}" for k in range(20)]], "\t"),
        (["a,b;c", *["x,y;z"] * 20], ","),
    ],
)
def test_cells_are_told_apart_by_what_leaves_most_numbers(lines: list[str], delimiter: str) -> None:
    assert told(*lines).delimiter == delimiter


@pytest.mark.parametrize(
    ("width", "names", "decimal"),
    [(3, 2, False), (4, 2, True), (5, 2, False), (4, 3, False), (5, 3, True), (6, 3, True), (7, 3, False)],
)
def test_decimal_commas_at_most_double_the_cells(width: int, names: int, decimal: bool) -> None:
    header = ",".join(["time", "voltage", "speed"][:names])
    line = ",".join(str(k + 1) for k in range(width))
    with pytest.raises(InputError) as refused:
        told(header, *[line] * 20)
    assert refused.value.where == "x.csv, line 2"
    whole = f"{width} values in {names} columns"
    assert refused.value.what == (
        f"{whole}: decimal commas between cells that commas separate" if decimal else whole
    )
