"""The noise that a fit's residuals show."""

from __future__ import annotations

import numpy as np
import pytest

from rwn.fit.noise import CLOCK, noise_of
from rwn.recording.noise import Noise, noise_from_differences
from rwn.recording.speed_measurement import CENTRAL
from rwn.simulate.run import Run


def test_no_position_is_better_known_than_the_clock() -> None:
    time = np.linspace(0.0, 1.0, 500)
    far = Run(name="far", time=time, input=0.0 * time, position=1000.0 * np.sin(1.5 * time))
    error = {"position": 1e-6 * np.random.default_rng(0).standard_normal(500)}
    assert noise_of([far], [error])["position"].level == pytest.approx(CLOCK * 1000.0 * np.sin(1.5))


def test_only_the_speed_is_as_exact_as_encoder_counts() -> None:
    rng, time = np.random.default_rng(1), np.linspace(0.0, 1.0, 2000)
    counts = np.round(300.0 * np.sin(2.0 * time)) * 1e-3
    current = np.round(rng.standard_normal(time.size) / 0.5) * 0.01  # a converter whose step is half of the noise
    run = Run(
        name="coarse", time=time, input=0.0 * time, current=current, speed=counts, position=counts,
        speed_measured=CENTRAL,
    )  # fmt: skip
    levels = noise_of([run], [{"current": current, "speed": current, "position": current}])
    assert levels["current"].level == pytest.approx(0.02, rel=0.3)
    assert levels["speed"].level < 1e-3


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
