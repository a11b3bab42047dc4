"""Signals that come in steps."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import rwn
from rwn.recording.quantisation import mean_rounding_error

DEMO = Path(rwn.__file__).parent / "demo"
STEP = 17.77  # rad/s


def diagnosed(step: float) -> rwn.Diagnosis:
    """The demonstration with its speed rounded to steps of so many rad/s."""
    model = rwn.read_model(DEMO / "model.toml")
    recording = rwn.read_recording(DEMO / "train.csv", layout=model.recording)
    speed = step * np.round(recording.signals["speed"] / step)
    return rwn.diagnose([replace(recording, signals={**recording.signals, "speed": speed})], model)


@pytest.fixture(scope="module")
def coarse() -> rwn.Diagnosis:
    return diagnosed(STEP)


@pytest.mark.slow
def test_a_coarse_speed_signal_is_named(coarse: rwn.Diagnosis) -> None:
    assert coarse.verdict == "missing-physics"
    assert {e.name for e in coarse.effects} == {"coulomb-friction", "sensor-quantization"}
    rounding = next(e for e in coarse.effects if e.name == "sensor-quantization")
    assert rounding.equation == "sensor"
    assert rounding.parameters["resolution"].value == pytest.approx(STEP, rel=1e-6)


@pytest.mark.parametrize("noise", [0.05, 0.2, 0.6])
def test_the_mean_rounding_error_is_that_of_rounded_draws(noise: float) -> None:
    rng = np.random.default_rng(3)
    cells = np.linspace(-1.7, 1.9, 41)
    drawn = cells[:, None] + noise * rng.standard_normal((41, 40_000))
    mean = np.mean(np.round(drawn), axis=1) - cells
    assert np.allclose(mean_rounding_error(cells, noise), mean, atol=0.012)


@pytest.mark.slow
def test_how_coarse_a_speed_is_does_not_bend_the_motor(coarse: rwn.Diagnosis) -> None:
    """A slow speed between two steps is shown wrong in the same way for long: plain least squares follows it."""
    first, second = (found.effects[0].parameters["coulomb_torque"].value for found in (coarse, diagnosed(30.0)))
    assert first == pytest.approx(second, rel=1e-3)  # 7e-3 without
