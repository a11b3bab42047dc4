"""What an instrument writes above the names of a CSV's columns, with numbers in as many cells as there are columns."""

from __future__ import annotations

import pytest

from rwn.errors import InputError
from rwn.recording.formats.csv_dialect import Dialect, dialect_of

WANTED = {"time", "voltage", "speed"}


def rows(count: int = 20) -> list[str]:
    return [f"{k / 10},{k}.5,-{k}" for k in range(count)]


def told(*lines: str, wanted: set[str] = WANTED) -> Dialect:
    return dialect_of(lines, wanted, "x.csv")


SCOPE = [
    "Model,MDO3024",
    "",
    "Waveform Type,ANALOG,",
    "Horizontal Scale,0.002,",
    "Gating,0.0% to 100.0%,",
    "Probe Attenuation,1,10",
    "Vertical Units,V,A",
    "Vertical Offset,0,0",
    "Label,,",
]


@pytest.mark.parametrize(
    "above",
    [
        SCOPE,
        ["Vertical Offset,0,0"],
        ["Channel,1,2"],
        ["Date,1,2", "1,2,3"],
        [*SCOPE, "1,2,3", "4,5,6"],
        ["0.1;10,3", "Channel,1,2"],
    ],
)
def test_numbers_that_an_instrument_writes_above_the_names(above: list[str]) -> None:
    found = told(*above, "time [s],voltage [V],speed [rpm]", *rows())
    assert (found.names, found.units) == (("time", "voltage", "speed"), ("s", "V", "rpm"))
    assert found.first == len(above) + 1
    below = told(*above, "time,voltage,speed", "s,V,rpm", *rows())
    assert (below.units, below.first) == (("s", "V", "rpm"), len(above) + 2)


def test_names_that_nobody_asked_for_below_an_instruments_numbers() -> None:
    found = told(*SCOPE, "TIME,CH1,CH2", *rows())
    assert (found.names, found.first) == (("TIME", "CH1", "CH2"), len(SCOPE) + 1)


def test_channels_that_are_called_by_numbers() -> None:
    """As Keysight writes them, units below."""
    found = told("x-axis,1,2", "second,Volt,Ampere", *rows())
    assert (found.names, found.units, found.first) == (("x-axis", "1", "2"), ("second", "Volt", "Ampere"), 2)
    assert told("x-axis,1,2", "second,Volt,Ampere", *rows(), wanted={"x-axis", "1", "2"}) == found
    assert told("x-axis,1,2", *rows(), wanted={"x-axis", "1", "2"}).first == 1
    assert told("s,V,rpm", *rows()).names == ("s", "V", "rpm"), "units alone"


def test_a_bad_first_row_is_not_taken_for_a_part_of_the_heading() -> None:
    assert told("time,voltage,speed", "0,x,1", *rows()).first == 1
    assert told("time,voltage,speed", "s,V,rpm", "0,,1", *rows()).first == 2
    assert told("0,x,1", *rows(), wanted={"1", "2", "3"}).first == 0


def test_names_below_a_recording_are_not_its_heading() -> None:
    """Two files in one, the first without names: nothing of it is passed over."""
    second = ["time,voltage,speed", *rows()]
    assert told("time,voltage,speed", *rows(), *second).first == 1
    assert told(*rows(count=4), *second).first == 5
    with pytest.raises(InputError, match="no row names the columns"):
        told(*rows(count=5), *second)
    with pytest.raises(InputError, match="no row names the columns"):
        told(*rows(count=5), "time,voltage,speed")
