"""A channel that is late by any part of a row is a hypothesis like a lag of its sensor, or a late input."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.signal import lfilter

import rwn
from ranked import ranked, ranked_from
from rwn.fit.preparation import prepare
from rwn.measurement.filter_colour import SensorFilter
from rwn.measurement.known_filters import filtered
from rwn.model.model import Model

DEMO = Path(rwn.__file__).parent / "demo"
KEPT = 0.5  # by the filter of the current


@pytest.fixture(scope="module")
def model() -> Model:
    return rwn.read_model(DEMO / "model.toml")


def _noisy(model: Model, recording: rwn.Recording) -> dict[str, np.ndarray]:
    out, rng = rwn.simulate(model, recording).signals, np.random.default_rng(1)
    return {s: out[s] + 0.01 * out[s].std() * rng.standard_normal(out[s].size) for s in ("current", "speed")}


def _half(model: Model) -> rwn.Recording:
    recording = rwn.read_recording(DEMO / "train.csv", layout=model.recording)
    return recording.beginning(len(recording) // 2)


@pytest.mark.parametrize(("late", "lag"), [(2, 0.0), (0, 4e-3)])
def test_a_late_speed_is_told_from_one_that_lags_beside_a_filtered_current(model: Model, late: int, lag: float) -> None:
    recording = _half(model)
    step = float(np.median(np.diff(recording.time)))
    effects = {"speed-sensor-lag": {"time_constant": lag}} if lag else {}
    noisy = _noisy(replace(model, effects=effects), recording)
    speed = np.concatenate([np.full(late, noisy["speed"][0]), noisy["speed"][: noisy["speed"].size - late]])
    current = lfilter([1.0 - KEPT], [1.0, -KEPT], noisy["current"])
    signals = {"voltage": recording.signals["voltage"], "current": current, "speed": speed}
    known = [SensorFilter(signal="current", share=KEPT, time_constant=-step / np.log(KEPT), digital=True)]
    problem = filtered(prepare([rwn.Recording(name="run", time=recording.time, signals=signals)], model), known)
    best = ranked(problem, ["speed-moving-average", "speed-sensor-lag", "speed-sensor-delay"], at_once=1).fits[0]
    assert best.added == (("speed-sensor-delay",) if late else ("speed-sensor-lag",))
    if late:
        assert best.final.values_of("speed-sensor-delay")["delay"] == pytest.approx(late * step, rel=0.02)


@pytest.mark.parametrize("rows", [0.37, 1.0, 2.6])
@pytest.mark.parametrize("late", [True, False])
def test_a_late_current_is_told_from_a_late_input(model: Model, late: bool, rows: float) -> None:
    """Though the inductance gives way to the delay of an input, and the speed hardly shows it."""
    model = replace(model, uncertainty={**model.uncertainty, "inductance": 0.2})
    recording = _half(model)
    delay = rows * float(np.median(np.diff(recording.time)))
    effect = "current-sensor-delay" if late else "input-delay"
    signals = {**recording.signals, **_noisy(replace(model, effects={effect: {"delay": delay}}), recording)}
    recordings = [rwn.Recording(name="run", time=recording.time, signals=signals)]
    best = ranked_from(recordings, model, ["input-delay", "current-sensor-delay"], at_once=1).fits[0]
    assert best.added == (effect,)
    assert best.final.values_of(effect)["delay"] == pytest.approx(delay, rel=0.05)
