"""Rows of a CSV: how they are read in blocks, counted, and which cell is refused."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from rwn.errors import InputError
from rwn.recording.formats import csv as module
from rwn.recording.formats.csv import read_csv, read_lines
from rwn.recording.formats.table import Table

HEADER = "time [s],voltage [V],speed [rpm]"
WANTED = ("time", "voltage", "speed")
FILLED = [f"{k},{k}.5,-{k}" for k in range(60)]


def _lines(*lines: str, each: int = 1000, wanted: tuple[str, ...] = WANTED) -> Table:
    blocks = ((k, list(lines[k : k + each])) for k in range(0, len(lines), each))
    return read_lines("run.csv", blocks, wanted)


def _refused(*lines: str, each: int = 1000) -> InputError:
    with pytest.raises(InputError) as refused:
        _lines(*lines, each=each)
    return refused.value


@pytest.mark.parametrize("each", [20, 37, 1000])
def test_blocks_are_put_together_and_rows_keep_their_lines(each: int) -> None:
    lines = ["# bench 3", HEADER, *FILLED[:25], "", "# half", *FILLED[25:], "EOF"]
    read = _lines(*lines, each=each)
    assert {name: x.tolist() for name, x in read.columns.items()} == {
        "time": list(range(60)), "voltage": [k + 0.5 for k in range(60)], "speed": [-k for k in range(60)],
    }  # fmt: skip
    assert [read.row(k) for k in (0, 24, 25, 59)] == ["line 3", "line 27", "line 30", "line 64"]
    assert read.units == {"time": "s", "voltage": "V", "speed": "rpm"}
    assert read.where == "run.csv"


def test_what_messages_call_a_line_is_said_by_who_reads() -> None:
    read = read_lines("run.xlsx", iter([(0, [HEADER, *FILLED])]), WANTED, line="row")
    assert read.row(3) == "row 5"


@pytest.mark.parametrize(
    ("lines", "row"),
    [
        ([HEADER, *FILLED[:30], "30,x,-30", *FILLED[31:]], 32),  # no number
        ([HEADER, *FILLED[:30], "30,,-30", *FILLED[31:]], 32),  # an empty cell
        ([HEADER, *FILLED[:30], "30,31", *FILLED[31:]], 32),  # a cell too few
        ([HEADER, *FILLED[:30], '"30,31,32', *FILLED[31:]], 32),  # an open quote
        (["time [s],voltage [V,speed [rpm]", *FILLED], 1),  # no name
        (["time [s],voltage [V,speed [rpm]", "a,b,c"], 1),  # nor numbers
        (FILLED, 1),  # no header
    ],
)
def test_every_refusal_of_a_spreadsheet_is_of_a_row(lines: list[str], row: int) -> None:
    with pytest.raises(InputError) as refused:
        read_lines("run.xlsx", iter([(0, lines)]), WANTED, line="row")
    assert refused.value.where.startswith(f"run.xlsx, row {row}")
    assert "line" not in str(refused.value).replace("line breaks", "")
    with pytest.raises(InputError) as refused:
        _lines(*lines)
    assert refused.value.where.startswith(f"run.csv, line {row}")


def test_columns_that_are_not_wanted_are_named_and_not_read() -> None:
    read = _lines(HEADER, *[line.replace(".5", " V") for line in FILLED], wanted=("speed",))
    assert list(read.columns) == ["speed"]
    assert list(read.units) == ["time", "voltage", "speed"]
    nothing = _lines(HEADER, *FILLED, wanted=())
    assert not nothing.columns


def test_a_header_alone_has_no_rows() -> None:
    assert {name: x.size for name, x in _lines(HEADER).columns.items()} == dict.fromkeys(WANTED, 0)


def test_more_rows_than_a_recording_may_have_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "MAX_SAMPLES", 60)
    assert _lines(HEADER, *FILLED).columns["time"].size == 60
    assert _refused(HEADER, *FILLED, "60,1,2").what == "61 samples are too many"


def test_two_columns_of_a_name_are_refused_where_they_are_wanted() -> None:
    assert _refused("time,speed,speed", *FILLED).what == "two columns are called 'speed'"
    assert set(_lines("time,x,x", *FILLED).columns) == {"time"}


@pytest.mark.parametrize(
    ("row", "what", "fix"),
    [
        ("60,abc,1", "'abc' in column 'voltage' is not a number", "correct it, or remove the line"),
        ("60, ,1", "column 'voltage' is empty", "complete the line or remove it"),
        ("60,1 000,1", "'1 000' in column 'voltage' is not a number", "export without them"),
        ("60,1_000,1", "'1_000' in column 'voltage' is not a number", "export without them"),
        (f"60,{'x' * 50},1", f"'{'x' * 40}' in column 'voltage' is not a number", "correct it, or remove the line"),
        ("60,1", "2 values in 3 columns", "complete the line or remove it"),
        ("60,1,2,3", "4 values in 3 columns", "complete the line or remove it"),
        ('60,"1,2', "a quote is left open", "close the quote; remove line breaks within cells"),
        ('"60","1,5","2"x"', "'2x\"' in column 'speed' is not a number", "correct it, or remove the line"),
    ],
)
@pytest.mark.parametrize("each", [30, 1000])
def test_a_bad_cell_is_refused_by_its_line(row: str, what: str, fix: str, each: int) -> None:
    said = _refused("# bench", HEADER, *FILLED, "", row, *FILLED[:5], each=each)
    assert (said.what, said.where, said.fix) == (what, "run.csv, line 64", fix)


@pytest.mark.parametrize("cell", ["1.000,5", "1,000,000", "1.000.000"])
def test_a_decimal_comma_stands_alone(cell: str) -> None:
    rows = [line.replace(",", ";").replace(".", ",") for line in FILLED]
    assert _lines(HEADER.replace(",", ";"), *rows).columns["voltage"][3] == 3.5
    said = _refused(HEADER.replace(",", ";"), *rows, f"60;{cell};1")
    assert (said.what, said.expected) == (
        f"'{cell}' in column 'voltage' is not a number", "a number without separators of thousands",
    )  # fmt: skip


def test_quotes_left_open_are_blamed_on_the_first_odd_line() -> None:
    said = _refused(HEADER, *FILLED, '60,"1",2', '61,"1,2', '62,1,"2')
    assert (said.what, said.where) == ("a quote is left open", "run.csv, line 63")


def _blocks(path: Path, size: int, monkeypatch: pytest.MonkeyPatch) -> list[tuple[int, list[str]]]:
    monkeypatch.setattr(module, "BLOCK", size)
    return list(module._blocks(path, "utf-8"))


@pytest.mark.parametrize("text", ["ab\ncd\nef\n", "ab\ncd\nef"])
@pytest.mark.parametrize("size", [3, 4, 5, 7, 100])
def test_a_block_ends_with_a_line(text: str, size: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "a.csv").write_text(text)
    blocks = _blocks(tmp_path / "a.csv", size, monkeypatch)
    assert [line for _, lines in blocks for line in lines] == ["ab", "cd", "ef"]
    firsts = np.cumsum([0, *(len(lines) for _, lines in blocks)])
    assert [at for at, _ in blocks] == firsts[:-1].tolist()


def test_a_line_longer_than_a_block_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "a.csv").write_text("ab\nabcdefgh\n" + "x" * 30)
    with pytest.raises(InputError) as refused:
        _blocks(tmp_path / "a.csv", 8, monkeypatch)
    assert refused.value.what == "the line is longer than 8 characters"
    assert refused.value.where == f"{tmp_path / 'a.csv'}, line 3"
    (tmp_path / "a.csv").write_text("abcdefg\n1234567")
    assert len(_blocks(tmp_path / "a.csv", 8, monkeypatch)) == 2


def test_the_dialect_is_told_from_the_first_lines_and_two_at_least(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "_SAMPLE", 10)
    assert module._sample(["abcd", "efgh", "ijkl"]) == ["abcd", "efgh"]  # each with the end of its line
    assert module._sample(["abc", "efgh", "ijkl", "mnop"]) == ["abc", "efgh", "ijkl"]
    assert module._sample(["a" * 50, "b" * 50, "c"]) == ["a" * 50, "b" * 50]
    assert module._sample(["abc"]) == ["abc"]
    assert module._sample([]) == []


def test_a_file_in_another_code_page_is_read_too(tmp_path: Path) -> None:
    """A sign that is no UTF-8 beyond the first bytes, from which the encoding is guessed."""
    rows: Iterator[str] = (f"{k},1.5,2,ok" for k in range(9000))
    text = "\n".join([f"{HEADER},note", *rows, "9000,1.5,2,\u00b0"])
    (tmp_path / "a.csv").write_bytes(text.encode("cp1252"))
    assert read_csv(tmp_path / "a.csv", WANTED).columns["time"].size == 9001
    (tmp_path / "b.csv").write_bytes(text.encode("cp1252") + b"\x81\x8d")  # signs of no code page
    with pytest.raises(InputError, match="this is not a text file"):
        read_csv(tmp_path / "b.csv", WANTED)
