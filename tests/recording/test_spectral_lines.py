"""Lines of a spectrum, told from what is smooth about them."""

from __future__ import annotations

import numpy as np
import pytest

from rwn.recording.spectral_lines import MOST_LINES, without_lines


@pytest.mark.parametrize("frequency", [0.03, 0.2376, 0.41])
@pytest.mark.parametrize("amplitude", [0.5, 5.0])
def test_a_line_is_taken_off_and_the_noise_is_left(frequency: float, amplitude: float) -> None:
    noise = np.random.default_rng(0).standard_normal(3000)
    line = amplitude * np.cos(2.0 * np.pi * frequency * np.arange(noise.size) + 1.0)
    off = without_lines(noise + line) - noise
    assert np.sqrt(np.mean(off**2)) < 0.06  # amplitude, phase and frequency are told to some 1 / sqrt(3000) each


def test_noise_without_lines_stays_as_it_is() -> None:
    draws = (np.random.default_rng(seed).standard_normal(600) for seed in range(300))
    assert sum(without_lines(x) is not x and bool(np.any(without_lines(x) != x)) for x in draws) <= 3


def test_several_lines_are_taken_off_the_clearest_first() -> None:
    rows = np.arange(4000)
    noise = np.random.default_rng(1).standard_normal(rows.size)
    lines = sum(10.0 / (k + 1) * np.sin(2.0 * np.pi * 0.05 * (k + 1) * rows) for k in range(MOST_LINES))
    off = without_lines(noise + lines) - noise
    assert np.sqrt(np.mean(off**2)) < 0.1


def test_samples_that_are_left_out_stay_left_out() -> None:
    noise = np.random.default_rng(2).standard_normal(3000)
    x = noise + 3.0 * np.sin(2.0 * np.pi * 0.1 * np.arange(noise.size))
    lost = np.random.default_rng(3).random(x.size) < 0.02
    found = without_lines(np.where(lost, np.nan, x))
    assert np.array_equal(np.isnan(found), lost)
    assert np.sqrt(np.mean((found - noise)[~lost] ** 2)) < 0.1


@pytest.mark.parametrize("x", [np.zeros(100), np.full(100, np.nan), np.arange(5.0)], ids=["0", "lost", "short"])
def test_what_holds_no_spectrum_stays_as_it_is(x: np.ndarray) -> None:
    assert np.array_equal(without_lines(x), x, equal_nan=True)
