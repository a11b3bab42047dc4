"""A recording as the core takes it: what the layout says of it counts before what its values show."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from made_up_motor import SMALL as MOTOR
from rwn.recording.layout import Layout
from rwn.recording.speed_measurement import BACKWARD, CENTRAL, INSTANTANEOUS, SpeedMeasurement
from rwn.simulate.recorded_run import run_of

MODEL = rwn.Model(kind="dc", parameters=MOTOR)


def _counted() -> rwn.Recording:
    """The speed of an encoder as a backward difference."""
    time = 1e-3 * np.arange(2000)
    counts = np.round(2000 / (2.0 * np.pi) * (40.0 * time + 3.0 * np.sin(9.0 * time)))
    speed = np.diff(counts, prepend=counts[0]) * 2.0 * np.pi / 2000 / 1e-3
    return rwn.Recording(name="run", time=time, signals={"voltage": np.ones(time.size), "speed": speed})


@pytest.mark.parametrize(("stated", "way"), [(None, BACKWARD), ((0, 0), INSTANTANEOUS), ((1, 1), CENTRAL)])
def test_how_a_speed_was_measured_may_be_stated(stated: tuple[int, int] | None, way: SpeedMeasurement) -> None:
    run = run_of(_counted(), replace(MODEL, recording=Layout(speed_rows=stated)))
    assert run.speed_measured == way
