"""How long a signal stood still."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import lfilter

from rwn.faults.standstill import first_moved


@pytest.mark.parametrize(("still", "kept"), [(12, 0.0), (40, 0.0), (40, 0.8), (700, 0.8)])
def test_a_motion_is_told_from_noise_that_a_filter_has_coloured(still: int, kept: float) -> None:
    """However the first few samples happen to lie."""
    for seed in range(50):
        white = np.random.default_rng(seed).standard_normal(still + 2000)
        noise = lfilter([1.0 - kept], [1.0, -kept], white)[1000:]
        moved = np.maximum(np.arange(still + 1000.0) - still, 0.0)  # in units of the noise before the filter
        found = first_moved(noise + moved)
        assert still - 1 <= found <= 2 * still + 10


def test_a_first_step_of_a_signal_that_was_constant_is_no_motion() -> None:
    """Also where the rows lie between the values of a coarse converter."""
    for seed in range(50):
        rng = np.random.default_rng(seed)
        steps = np.rint(0.3 * rng.standard_normal(1500)) + np.maximum(np.arange(1500) - 60, 0) // 2
        when = np.arange(1500.0) + rng.uniform(-0.3, 0.3, 1500)
        for signal in (steps, np.interp(when, np.arange(1500.0), steps)):
            assert 60 <= first_moved(signal) <= 130


def test_a_signal_that_swings_from_its_first_sample_does_not_stand_still() -> None:
    time = 1e-3 * np.arange(2000)
    signal = 60.0 * np.sin(25.0 * time) + 0.5 * np.random.default_rng(0).standard_normal(time.size)
    assert first_moved(signal) < 30


def test_few_rows_of_a_clean_signal_show_at_once_that_it_moves() -> None:
    """A position in counts that sets off with the first rows and comes to rest: it stood for one sample."""
    counts = np.round(800.0 * (1.0 - np.exp(-np.arange(50.0) / 6.0)))
    assert first_moved(0.002 * counts) <= 4
