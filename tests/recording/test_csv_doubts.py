"""CSV files that say something in two ways."""

from __future__ import annotations

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
    with pytest.raises(InputError, match="column 'time' is in ms by its name and in s by the row of units below"):
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
    with pytest.raises(InputError, match=r"'-1\.2\d\d' may be in thousands or have a decimal point"):
        read_recording(path)
