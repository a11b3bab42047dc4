"""Signals that come in steps."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import rwn
from rwn.recording.quantisation import mean_rounding_error

DEMO = Path(rwn.__file__).parent / "demo"


@pytest.mark.slow
def test_a_coarse_speed_signal_is_named() -> None:
    model = rwn.read_model(DEMO / "model.toml")
    recording = rwn.read_recording(DEMO / "train.csv", layout=model.recording)
    step = 17.77
    speed = step * np.round(recording.signals["speed"] / step)
    found = rwn.diagnose([replace(recording, signals={**recording.signals, "speed": speed})], model)
    assert found.verdict == "missing-physics"
    assert {e.name for e in found.effects} == {"coulomb-friction", "sensor-quantization"}
    rounding = next(e for e in found.effects if e.name == "sensor-quantization")
    assert rounding.equation == "sensor"
    assert rounding.parameters["resolution"].value == pytest.approx(step, rel=1e-6)


@pytest.mark.parametrize("noise", [0.05, 0.2, 0.6])
def test_the_mean_rounding_error_is_that_of_rounded_draws(noise: float) -> None:
    rng = np.random.default_rng(3)
    cells = np.linspace(-1.7, 1.9, 41)
    drawn = cells[:, None] + noise * rng.standard_normal((41, 40_000))
    mean = np.mean(np.round(drawn), axis=1) - cells
    assert np.allclose(mean_rounding_error(cells, noise), mean, atol=0.012)


@pytest.mark.slow
def test_how_coarse_a_speed_is_does_not_bend_the_motor() -> None:
    """A slow speed between two steps is shown wrong in the same way for long: plain least squares follows it."""
    model = rwn.read_model(DEMO / "model.toml")
    recording = rwn.read_recording(DEMO / "train.csv", layout=model.recording)
    torques = []
    for step in (17.77, 30.0):
        speed = step * np.round(recording.signals["speed"] / step)
        found = rwn.diagnose([replace(recording, signals={**recording.signals, "speed": speed})], model)
        torques.append(found.effects[0].parameters["coulomb_torque"].value)
    assert torques[0] == pytest.approx(torques[1], rel=1e-3)  # 7e-3 without
