"""A run as its signals were before a filter."""

from __future__ import annotations

import numpy as np
import pytest

from made_up_motor import MOTOR
from rwn.model.model import Model
from rwn.recording.filters import as_filtered
from rwn.recording.recording import Recording
from rwn.simulate.recorded_run import run_of
from rwn.simulate.run import Run

MODEL = Model(kind="dc", parameters=MOTOR)
TIME = 1e-3 * np.arange(400)
SPEED, CURRENT = 40.0 * np.sin(15.0 * TIME), np.cos(15.0 * TIME)


def _run(speed: np.ndarray, current: np.ndarray) -> Run:
    signals = {"voltage": np.sin(15.0 * TIME), "speed": speed, "current": current}
    return run_of(Recording(name="run", time=TIME, signals=signals), MODEL)


def test_the_angle_goes_with_the_speed_and_not_with_the_current() -> None:
    plain = _run(SPEED, CURRENT)
    of_current = _run(SPEED, as_filtered(TIME, CURRENT, 3e-3)).unfiltered("current", 3e-3)
    assert of_current.current == pytest.approx(CURRENT, abs=1e-9)
    assert of_current.angle == pytest.approx(plain.angle, abs=1e-12)
    of_speed = _run(as_filtered(TIME, SPEED, 3e-3), CURRENT).unfiltered("speed", 3e-3)
    assert of_speed.speed == pytest.approx(SPEED, abs=1e-9)
    assert of_speed.angle == pytest.approx(plain.angle, abs=1e-9)
