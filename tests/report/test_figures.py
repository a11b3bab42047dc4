"""Pictures as data: what is drawn of many samples."""

from __future__ import annotations

import numpy as np
import pytest

import rwn
from made_up_motor import MOTOR, recorded
from rwn.report.figures import MOST_POINTS, _thin


@pytest.mark.parametrize("length", [100, 20_001, 150_000])
def test_no_spike_is_lost(length: int) -> None:
    y = np.zeros(length)
    y[length // 2 + 1] = 100.0
    x, thin, flat = _thin(np.arange(length, dtype=np.float64), y, 0.0 * y)
    assert x.size <= MOST_POINTS + 2
    assert thin.max() == 100.0
    assert thin.size == flat.size == x.size
    assert (x[0], x[-1]) == (0.0, length - 1.0)


@pytest.mark.slow
def test_a_burst_of_a_recording_is_drawn_and_a_spike_is_said() -> None:
    run = recorded(1, lambda w, _: -0.004 * np.sign(w), 6000)
    speed = run.signals["speed"].copy()
    place = 4003
    speed[place : place + 3] += 500.0
    speed[1001] -= 500.0
    spiked = rwn.Recording(name="spiked", time=run.time, signals={**run.signals, "speed": speed})
    found = rwn.diagnose([spiked], rwn.Model(kind="dc", parameters=MOTOR))
    drawn = next(p for p in found.curves if p.slot == "response").traces[0]
    assert np.max(drawn.y) == pytest.approx(np.max(speed))
    assert [(f.kind, f.count) for f in found.findings] == [("spikes", 1)]
