"""Instants as loggers write them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import rwn
from rwn.recording.formats.stamps import instant


@pytest.mark.parametrize(
    "cell",
    [
        "2026-11-30T14:03:22.417", "2026-11-30 14:03:22,417", "2026/11/30 14:03:22.417", "30.11.2026 14:03:22,417",
        " 30.11.2026  14:03:22.417 ", "2026-11-30T15:03:22.417+01:00",
    ],
)  # fmt: skip
def test_an_instant_is_read_in_each_way_of_writing_it(cell: str) -> None:
    assert instant(cell) == np.datetime64("2026-11-30T14:03:22.417", "ns")


def test_a_time_of_day_is_one_of_any_day() -> None:
    first, second = instant("14:03:22,417"), instant("14:03:22,42")
    assert first is not None
    assert second is not None
    assert second - first == np.timedelta64(3, "ms")


@pytest.mark.parametrize("cell", ["31.06.2026 14:03:22", "11/30/2026 14:03:22", "14.03", "3.5", "25:00:00", ""])
def test_what_is_none_or_may_be_another_is_none(cell: str) -> None:
    assert instant(cell) is None


def test_a_logger_with_decimal_commas_is_read_with_its_stamps(tmp_path: Path) -> None:
    rows = [f"30.11.2026 14:03:00,{k:03d};{1 + 0.5 * k:.1f};{k}".replace(".5;", ",5;") for k in range(100)]
    file = tmp_path / "log.csv"
    file.write_text("time;voltage [V];speed [rad/s]\n" + "\n".join(rows).replace(".0;", ",0;") + "\n")
    read = rwn.read_recording(file)
    assert read.time == pytest.approx(1e-3 * np.arange(100))
    assert read.signals["voltage"] == pytest.approx(1.0 + 0.5 * np.arange(100))
