"""CSV as instruments and spreadsheets write it: every disguise gives the same recording, or the right remedy."""

from __future__ import annotations

import tracemalloc
from pathlib import Path

import numpy as np
import pytest

from rwn.errors import InputError
from rwn.recording.layout import Column, Layout
from rwn.recording.recording import Recording, read_recording

TIME = np.arange(120) * 1e-3
VOLTAGE = np.round(6.0 * np.sin(40.0 * TIME), 3)
RPM = np.round(900.0 * np.sin(40.0 * TIME - 0.4), 2)


def _rows(delimiter: str = ",", decimal: str = ".", quote: str = "", end: str = "\n", last: str = "") -> str:
    return "".join(
        delimiter.join(f"{quote}{x:.3f}{quote}".replace(".", decimal) for x in row) + last + end
        for row in zip(TIME, VOLTAGE, RPM, strict=True)
    )


HEADER = "time [s],voltage [V],speed [rpm]\n"

DISGUISES: dict[str, bytes] = {
    "as documented": (HEADER + _rows()).encode(),
    "parentheses": ("time (s),voltage (V),speed (rpm)\n" + _rows()).encode(),
    "slashes": ("time / s;voltage / V;speed / rpm\n" + _rows(";", ",")).encode(),
    "in": ("time in s;voltage in V;speed in rpm\n" + _rows(";", ",")).encode(),
    "units in a second row": ("time,voltage,speed\ns,V,rpm\n" + _rows()).encode(),
    "units in brackets in a second row": ("time;voltage;speed\n[s];[V];(rpm)\n" + _rows(";")).encode(),
    "types between names and numbers": ("time [s],voltage [V],speed [rpm]\nfloat,float,float\n" + _rows()).encode(),
    "text above": ("Recorded by bench 3\nOperator: J. Doe, night shift\n\n" + HEADER + _rows()).encode(),
    "keys and values above": ("Device,Scope\nRate,1000\nDate,2024-05-01\n\n" + HEADER + _rows()).encode(),
    "a comment sign before the header": ("# " + HEADER + _rows()).encode(),
    "comments above and between": ("# bench 3\n" + HEADER + "# started\n" + _rows() + "# stopped\n").encode(),
    "quoted header": ('"time [s]","voltage [V]","speed [rpm]"\n' + _rows()).encode(),
    "every cell quoted": ('"time [s]","voltage [V]","speed [rpm]"\n' + _rows(quote='"')).encode(),
    "quoted decimal commas": ('"time [s]","voltage [V]","speed [rpm]"\n' + _rows(quote='"', decimal=",")).encode(),
    "semicolons, decimal commas": (HEADER.replace(",", ";") + _rows(";", ",")).encode(),
    "tabs, decimal commas": (HEADER.replace(",", "\t") + _rows("\t", ",")).encode(),
    "bars": (HEADER.replace(",", "|") + _rows("|")).encode(),
    "spaces after commas": (HEADER.replace(",", ", ") + _rows(", ")).encode(),
    "UTF-16 with a mark": (HEADER.replace(",", "\t") + _rows("\t", ",")).encode("utf-16"),
    "UTF-16 without a mark": (HEADER + _rows()).encode("utf-16-le"),
    "UTF-8 with a mark": b"\xef\xbb\xbf" + (HEADER + _rows()).encode(),
    "Windows' code page": ("time [s],voltage [V],speed [rpm],\u00b5 [\u00b0]\n" + _rows(last=",1.0")).encode("cp1252"),
    "lines of Windows": (HEADER + _rows(end="\r\n")).encode(),
    "lines of an old Mac": (HEADER + _rows()).replace("\n", "\r").encode(),
    "a comma at the end of every line": (HEADER.replace("\n", ",\n") + _rows(last=",")).encode(),
    "two of them": (HEADER.replace("\n", ",,\n") + _rows(last=",,")).encode(),
    "no end of the last line": (HEADER + _rows()).rstrip().encode(),
    "blank lines": (HEADER + "\n" + _rows(end="\n\n")).encode(),
    "text in other columns": ("time [s],voltage [V],speed [rpm],note\n" + _rows(last=',"on, and on"')).encode(),
    "other columns that are called alike": ("time [s],voltage [V],speed [rpm],x,x\n" + _rows(last=",1,2")).encode(),
}  # fmt: skip


def _read(folder: Path, content: bytes, layout: Layout | None = None) -> Recording:
    (folder / "run.csv").write_bytes(content)
    return read_recording(folder / "run.csv", layout=layout)


@pytest.mark.parametrize("disguise", DISGUISES)
def test_every_disguise_gives_the_same_recording(disguise: str, tmp_path: Path) -> None:
    read = _read(tmp_path, DISGUISES[disguise])
    assert list(read.signals) == ["voltage", "speed"]
    np.testing.assert_allclose(read.time, TIME, atol=1e-12)
    np.testing.assert_allclose(read.signals["voltage"], VOLTAGE, atol=1e-12)
    np.testing.assert_allclose(read.signals["speed"], RPM * np.pi / 30.0, atol=1e-9)


def test_columns_without_a_header_are_mapped_by_number(tmp_path: Path) -> None:
    places = (("time", "1", "s"), ("voltage", "2", "V"), ("speed", "3", "rpm"))
    columns = {name: Column(source=place, unit=unit) for name, place, unit in places}
    read = _read(tmp_path, _rows().encode(), Layout(columns=columns))
    np.testing.assert_allclose(read.signals["voltage"], VOLTAGE)


def test_columns_that_are_not_used_are_noted(tmp_path: Path) -> None:
    header = "time [s],voltage [V],speed [rpm],state,temperature [degC]\n"
    read = _read(tmp_path, (header + _rows(last=",ok,20")).encode())
    assert any("not used: state, temperature" in warning for warning in read.warnings)


# name: (content, what the line must hold)
REFUSED: dict[str, tuple[str, tuple[str, ...]]] = {
    "decimal commas between commas": (HEADER + _rows(decimal=","), ("decimal commas", "another separator", "line 2")),
    "decimal commas between commas, after whole numbers": (
        HEADER + "0,-1,22,0,5\n" + _rows(decimal=","), ("decimal commas", "another separator")
    ),
    "separators of thousands": (
        HEADER.replace(",", ";") + _rows(";").replace("0.005;1.192", "0.005;1,111.192"),
        ("'1,111.192' in column 'voltage'", "separators of thousands", "line 7"),
    ),
    "separators of thousands in Python's way": (HEADER + _rows().replace("0.005,", "1_000,"), ("'1_000'", "line 7")),
    "no header": (_rows(), ("no row names the columns", "line 1", 'source = "3"')),
    "a name too few": ("time [s],voltage [V]\n" + _rows(), ("3 values in 2 columns", "name every column")),
    "a cut last line": (HEADER + _rows() + "0.120,1.", ("line 122", "2 values in 3 columns", "complete the line")),
    "quotes that go on in the next line": (
        HEADER + _rows().replace("0.100,", '0.100","x","', 1), ("line 102", "a quote is left open"),
    ),
    "a quote left open": (HEADER + _rows().replace("0.100,", '"0.100,', 1), ("line 102", "a quote is left open")),
    "a unit in parentheses that there is not": (HEADER.replace("[rpm]", "(bogus)") + _rows(), ("'bogus'",)),
    "a longer line in between": (HEADER + _rows().replace("0.100,", "0.1,7,", 1), ("line 102", "4 values in 3 ")),
    "a name of a million letters": ("x" * 10**6 + "," + HEADER + _rows(last=",1"), ("fix:",)),
}  # fmt: skip


@pytest.mark.parametrize("case", REFUSED)
def test_what_cannot_be_read_is_refused_with_its_remedy(case: str, tmp_path: Path) -> None:
    text, held = REFUSED[case]
    with pytest.raises(InputError) as refused:
        _read(tmp_path, text.encode())
    assert len(str(refused.value)) < 2000
    for part in held:
        assert part in str(refused.value)


def test_lines_are_counted_over_blocks_blank_lines_and_comments(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("rwn.recording.formats.csv.BLOCK", 300)
    text = HEADER + _rows().replace("0.050,", "\n# half\n0.050,").replace("0.100,", "abc,")
    with pytest.raises(InputError, match="line 104: 'abc' in column 'time'"):
        _read(tmp_path, text.encode())


@pytest.mark.slow
def test_memory_is_that_of_the_numbers_not_of_the_text(tmp_path: Path) -> None:
    """Two copies of the wanted columns (10 MB) and a few blocks of text, of 45 MB."""
    rows = 200_000
    with (tmp_path / "run.csv").open("w") as file:
        file.write("time [s],voltage [V]," + ",".join(f"x{k}" for k in range(20)) + ",speed [rpm]\n")
        filler = "1234.5678," * 20
        file.writelines(f"{k * 1e-4:.4f},{k % 7},{filler}{k % 90}\n" for k in range(rows))
    size = (tmp_path / "run.csv").stat().st_size
    tracemalloc.start()
    read = read_recording(tmp_path / "run.csv")
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert len(read) == rows
    assert size > 40e6
    assert peak < 20e6
