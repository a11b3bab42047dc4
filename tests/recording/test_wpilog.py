"""Units of a WPILib data log, as each of those who write them does."""

from __future__ import annotations

import pytest

from rwn.recording.formats.wpilog import _unit
from rwn.recording.units import same


@pytest.mark.parametrize(
    ("metadata", "unit"),
    [
        ('{"source":"AdvantageKit","unit":"rad/s"}', "rad/s"), ('{"units": "rpm"}', "rpm"),
        ('{"source":"NT"}', None), ('{"unit": 7}', None), ("{not JSON", None), ("{" * 5000, None), ("[1]", None),
        ("Meter per Second", "m/s"), ("A", "A"), ("mA", "mA"), ("", None),
    ],
)  # fmt: skip
def test_the_unit_of_an_entry_is_read_from_its_metadata(metadata: str, unit: str | None) -> None:
    told = _unit(metadata)
    assert told is None if unit is None else told is not None and same(told, unit, where="a log")
