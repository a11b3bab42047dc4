"""The noise that a fit's residuals show."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from made_up_motor import SMALL
from rwn.fit.fit import fit_nominal
from rwn.fit.preparation import prepare
from rwn.fit.residual_noise import CLOCK, noise_of, with_noise_of
from rwn.measurement.filter_colour import SensorFilter
from rwn.measurement.known_filters import filtered
from rwn.measurement.noise_spectrum import NoiseColour
from rwn.model.model import Model
from rwn.recording.filters import as_filtered
from rwn.recording.noise import Noise, noise_from_differences
from rwn.recording.speed_measurement import BACKWARD, CENTRAL, SpeedMeasurement, difference
from rwn.simulate.run import Run

MODEL = Model(kind="dc", parameters=SMALL, uncertainty={"inertia": 0.1})

@pytest.mark.parametrize("time_constant", [2e-3, 5e-3])
def test_noise_went_through_the_filter_that_the_motion_shows(time_constant: float) -> None:
    """Whatever the noise was taken for, when the filter was found in it."""
    time, rng = 1e-3 * np.arange(3000), np.random.default_rng(3)
    voltage = np.repeat(24.0 * rng.uniform(-1.0, 1.0, 60), 50)
    lag = {"speed-sensor-lag": {"time_constant": time_constant}}
    run = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    noise = as_filtered(time, rng.standard_normal(time.size), time_constant)
    speed = rwn.simulate(replace(MODEL, effects=lag), run).signals["speed"] + noise
    problem = prepare([replace(run, signals={**run.signals, "speed": speed})], MODEL)
    seen = NoiseColour(share=0.5, deviation=0.3, evidence=1.0, filtered=1.0)
    told = SensorFilter(signal="speed", share=0.5, time_constant=-1e-3 / np.log(0.5), noise=seen)
    beside = filtered(problem, [told])
    fitted = fit_nominal(beside)
    noise_then = with_noise_of(beside, fitted).noise["speed"]
    assert noise_then.reflection == pytest.approx([np.exp(-1e-3 / time_constant)], rel=0.02)
    assert not with_noise_of(problem, fitted).noise["speed"].reflection, "another filter may be asked of the problem"


def test_no_position_is_better_known_than_the_clock() -> None:
    time = np.linspace(0.0, 1.0, 500)
    far = Run(name="far", time=time, input=0.0 * time, position=1000.0 * np.sin(1.5 * time))
    error = {"position": 1e-6 * np.random.default_rng(0).standard_normal(500)}
    assert noise_of([far], [error])["position"].level == pytest.approx(CLOCK * 1000.0 * np.sin(1.5))


@pytest.mark.parametrize(
    ("way", "irregular"), [(BACKWARD, 0.0), (BACKWARD, 0.5), (CENTRAL, 0.0), (SpeedMeasurement(4, 0), 0.0)]
)
def test_counts_are_as_exact_as_their_steps_and_the_places_of_their_lines(
    way: SpeedMeasurement, irregular: float
) -> None:
    rng, time = np.random.default_rng(1), np.arange(4000) * 1e-3
    angle = 1e-3 * (300.0 * np.sin(2.0 * time) + 4000.0 * time)
    counts = 1e-3 * np.floor(angle / 1e-3 + irregular * rng.standard_normal(time.size))
    speed, true = (difference(way, time, x) for x in (counts, angle))
    run = Run(name="counted", time=time, input=0.0 * time, speed=speed, position=counts, speed_measured=way)
    errors = {"speed": speed - true, "position": counts - angle + 0.5e-3}
    levels = noise_of([run], [errors])
    for signal, error in errors.items():
        assert levels[signal].level == pytest.approx(np.std(error[5:-5]), rel=0.12), signal


def test_a_converter_whose_step_is_half_of_the_noise() -> None:
    time = np.linspace(0.0, 1.0, 2000)
    current = np.round(np.random.default_rng(1).standard_normal(time.size) / 0.5) * 0.01
    run = Run(name="coarse", time=time, input=0.0 * time, current=current)
    assert noise_of([run], [{"current": current}])["current"].level == pytest.approx(0.02, rel=0.3)


def test_noise_from_differences_passes_over_a_motion_sharp_instants_and_what_is_missing() -> None:
    rng, time = np.random.default_rng(4), np.linspace(0.0, 1.0, 4000)
    signal = 50.0 * np.sin(6.0 * time) + 0.02 * rng.standard_normal(time.size)
    signal[::400] += 3.0
    signal[100:150] = np.nan
    assert noise_from_differences(signal) == pytest.approx(0.02, rel=0.1)
    assert noise_from_differences(np.zeros(2)) == 0.0


def test_the_innovations_of_filtered_noise_are_white() -> None:
    rng = np.random.default_rng(5)
    fresh = rng.standard_normal(5000)
    errors = np.zeros(5000)
    for k in range(1, 5000):
        errors[k] = 0.6 * errors[k - 1] + fresh[k]
    noise = Noise(level=1.0, reflection=(0.6,))
    assert np.std(noise.innovations(errors)) == pytest.approx(1.0, rel=0.05)
    assert noise.deviation == pytest.approx(np.std(errors), rel=0.1)


def test_values_that_are_held_do_not_say_how_large_the_noise_is() -> None:
    noise = np.random.default_rng(3).standard_normal(4000)
    held = {"speed": np.arange(4000) % 5 > 0}
    time, speed = 1e-3 * np.arange(4000), np.repeat(noise[::5], 5)
    run = Run(name="held", time=time, input=0.0 * time, speed=speed, missing=held)
    left = np.where(run.missing["speed"], 0.0, run.speed)  # 0 where it is not compared
    assert noise_of([run], [{"speed": left}])["speed"].level == pytest.approx(1.0, rel=0.1)
