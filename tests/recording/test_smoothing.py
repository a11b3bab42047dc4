"""Recorded signals are smoothed over as many samples as leave the motion as it is."""

from __future__ import annotations

import numpy as np
import pytest

from rwn.recording.smoothing import LENGTHS, smooth, smoothing_length

RNG = np.random.default_rng(4)
STEP = 1e-3
TIME = STEP * np.arange(4000)


@pytest.mark.parametrize("frequency", [0.5, 3.0, 20.0, 60.0])  # Hz
def test_what_is_taken_off_is_noise(frequency: float) -> None:
    noise = 0.02
    true = np.sin(2.0 * np.pi * frequency * TIME)
    seen = true + noise * RNG.standard_normal(TIME.size)
    shown = smooth(seen, smoothing_length(seen))
    assert np.sqrt(np.mean((shown - true) ** 2)) < noise


def test_a_slow_motion_is_smoothed_most_and_a_fast_one_least() -> None:
    lengths = [
        smoothing_length(np.sin(2.0 * np.pi * f * TIME) + 0.02 * RNG.standard_normal(TIME.size))
        for f in (0.5, 25.0, 120.0)
    ]
    assert lengths[0] == LENGTHS[0]
    assert lengths == sorted(lengths, reverse=True)
    assert lengths[-1] == LENGTHS[-1]


def test_the_steps_of_a_coarse_signal_are_smoothed_as_noise() -> None:
    step = 0.2
    seen = step * np.round(np.sin(3.0 * TIME) / step)
    assert smoothing_length(seen) < LENGTHS[0]
    assert smoothing_length(seen, resolution=step / np.sqrt(12.0)) == LENGTHS[0]


def test_slopes_of_a_cubic_are_exact() -> None:
    t = TIME[:200]
    np.testing.assert_allclose(smooth(t**3, 31, derivative=1, step=STEP), 3.0 * t**2, atol=1e-10)
    np.testing.assert_allclose(smooth(t**3, 31, derivative=2, step=STEP), 6.0 * t, atol=1e-7)


def test_too_few_samples_are_left_as_they_are() -> None:
    few = np.array([1.0, 2.0, 4.0, 3.0])
    np.testing.assert_array_equal(smooth(few, 31), few)
    np.testing.assert_array_equal(smooth(few, 31, derivative=1), np.zeros(4))


def test_what_is_shorter_than_the_longest_window_is_taken_whole() -> None:
    assert smoothing_length(RNG.standard_normal(LENGTHS[0])) == LENGTHS[0]
