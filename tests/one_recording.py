"""One recording, as the tests of formats write it and read it again."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import pytest

from rwn.recording.recording import Recording

TIME = np.arange(80) * 0.02
VOLTAGE = 5.0 * np.sin(TIME)
RPM = 300.0 * np.sin(TIME - 0.2)
RADIANS = RPM * np.pi / 30.0
NAMED = {"time [s]": TIME, "voltage [V]": VOLTAGE, "speed [rpm]": RPM}
UNITS = {"time": "s", "voltage": "V", "speed": "rpm"}


def imported(module: str) -> Any:
    """The module of an extra; the test is skipped where it is not installed."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return pytest.importorskip(module)


def as_meant(read: Recording) -> None:
    """It is the recording that was written."""
    np.testing.assert_allclose(read.time, TIME, atol=1e-12)
    np.testing.assert_allclose(read.signals["voltage"], VOLTAGE)
    np.testing.assert_allclose(read.signals["speed"], RADIANS, rtol=1e-6, atol=1e-6)


def pandas_timetable() -> Any:
    """A frame whose index holds the times, and no names hold units."""
    pandas = imported("pandas")
    return pandas.DataFrame(
        {"Voltage": VOLTAGE, "Speed": RPM},
        index=pandas.Index(pandas.to_timedelta(np.round(1e3 * TIME), unit="ms").astype("timedelta64[ms]"), name="Time"),
    )
