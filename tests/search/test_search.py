"""What recordings told of themselves stands in the layout of the model that is found."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from made_up_motor import SMALL as MOTOR
from rwn.recording.speed_measurement import BACKWARD, CENTRAL, INSTANTANEOUS, SpeedMeasurement
from rwn.search.search import _stating_speed
from rwn.simulate.recorded_run import run_of

MODEL = rwn.Model(kind="dc", parameters=MOTOR)


@pytest.mark.parametrize(("way", "stated"), [(BACKWARD, (1, 0)), (CENTRAL, (1, 1)), (INSTANTANEOUS, (0, 0))])
def test_how_a_speed_was_measured_is_stated_for_others(way: SpeedMeasurement, stated: tuple[int, int]) -> None:
    signals = {"voltage": np.ones(50), "speed": np.linspace(0.0, 1.0, 50)}
    recording = rwn.Recording(name="run", time=1e-3 * np.arange(50), signals=signals)
    run = replace(run_of(recording, MODEL), speed_measured=way)
    assert _stating_speed(MODEL, [run]).recording.speed_rows == stated
    assert _stating_speed(MODEL, [replace(run, speed=np.empty(0))]).recording.speed_rows is None
