"""CSV files that say something in two ways."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from rwn.errors import InputError
from rwn.recording.recording import read_recording


def _written(folder: Path, head: str, row: str) -> Path:
    path = folder / "run.csv"
    path.write_text(head + "".join(row.format(k=k) for k in range(10, 60)))
    return path


@pytest.mark.parametrize(("below", "refused"), [("s,V,rad/s", True), ("ms,V,rad/s", False), (",V,", False)])
def test_a_row_of_units_that_contradicts_the_names_is_refused(below: str, refused: bool, tmp_path: Path) -> None:
    path = _written(tmp_path, f"time [ms],voltage,speed (rad/s)\n{below}\n", "{k},1.{k},0.{k}\n")
    if not refused:
        assert read_recording(path).time[1] == pytest.approx(11e-3)
        return
    with pytest.raises(InputError, match="column 'time' is in ms and, by a row of units, in s;"):
        read_recording(path)


@pytest.mark.parametrize(
    ("row", "refused"),
    [
        ("0,0{k};-1.2{k};-0,9{k}\n", True),  # 1.2 V or 1200 mV
        ("0.0{k};-1,2{k};-0,9{k}\n", False),  # no thousands begin with 0
        ("0,0{k};-1.2{k}5;-0,9{k}\n", False),
        ("0.0{k};-1.2{k};-0.9{k}\n", False),
    ],
)
def test_points_that_may_mark_thousands_beside_decimal_commas_are_refused(
    row: str, refused: bool, tmp_path: Path
) -> None:
    path = _written(tmp_path, "time [s];voltage [mV];speed [rad/s]\n", row)
    if not refused:
        assert read_recording(path).signals["voltage"][0] == pytest.approx(-1.21e-3, rel=1e-2)
        return
    with pytest.raises(InputError, match=r"'-1\.2\d\d' in column 'voltage' may be in thousands or have a decimal p"):
        read_recording(path)


HEAD = "time [s];voltage [mV];speed [rad/s]\n"


@pytest.mark.parametrize(
    ("rows", "cell"),
    [
        ('0.0{k};"-1,2{k}";-0.9{k}\n', "-1,2"),  # points are decimal elsewhere
        ("0,0{k};-1,5{k}1;-0,9{k}\n" * 20 + "0,9;-1.010;0,1\n" + "1,0{k};-1,5{k}1;-0,9{k}\n" * 200, "-1.010"),
        ("0,9;-1.010;0,1\n" + "0,0{k};-1,5{k}1;-0,9{k}\n", "-1.010"),  # before its decimal commas
        ("1{k};1,2{k};1\n" + "2{k};738;1\n", "1,2"),  # a comma in some of whole numbers
    ],
)
def test_one_cell_of_another_mark_anywhere_is_refused(rows: str, cell: str, tmp_path: Path) -> None:
    path = tmp_path / "run.csv"
    path.write_text(HEAD + "".join(rows.format(k=k) for k in range(10, 60)))
    with pytest.raises(InputError, match=rf"'{re.escape(cell)}\d*' in column 'voltage' may be in thousands"):
        read_recording(path)


def test_units_above_the_names_or_in_two_rows_may_not_contradict(tmp_path: Path) -> None:
    for head in ("s,V,rpm\ntime [s],voltage [V],speed [rad/s]\n", "time,voltage,speed\ns,V,rpm\ns,V,rad/s\n",
                 "time [s],voltage [V],speed [rad/s]\nclock,motor,motor\ns,V,rpm\n"):  # fmt: skip
        with pytest.raises(InputError, match=r"'speed' is in (rad/s|rpm) and, by a row of units, in (rpm|rad/s);"):
            read_recording(_written(tmp_path, head, "0.0{k},1.{k},0.{k}\n"))


def test_rows_of_numbers_above_the_names_are_said(tmp_path: Path) -> None:
    path = _written(tmp_path, "1,2,3\n4,5,6\ntime [s],voltage [V],speed [rad/s]\n", "0.0{k},1.{k},0.{k}\n")
    run = read_recording(path)
    assert len(run) == 50
    assert any("2 lines of numbers above the names are left out" in warning for warning in run.warnings)
