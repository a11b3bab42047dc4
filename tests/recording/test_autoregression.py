"""Errors as an autoregression."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import lfilter

from rwn.recording.noise import STABLE, WHITE, autoregression

NEW = np.random.default_rng(2).standard_normal((2, 40_000))


def test_an_autoregression_is_found_again() -> None:
    """x_k = 1.2 x_(k-1) - 0.5 x_(k-2) + e_k: partial autocorrelations 1.2 / 1.5 and -0.5 (Kay 1988, ch. 6)."""
    errors = [lfilter([0.3], [1.0, -1.2, 0.5], new) for new in NEW]
    found = autoregression(errors, 4)
    assert found.reflection == pytest.approx((0.8, -0.5, 0.0, 0.0), abs=0.01)
    assert found.level == pytest.approx(0.3, rel=0.01)
    assert found.deviation == pytest.approx(float(np.std(errors)), rel=0.02)
    new = np.concatenate([found.innovations(e) for e in errors])
    assert np.mean(new**2) == pytest.approx(1.0, rel=0.01)
    assert abs(float(np.mean(new[1:] * new[:-1]))) < 0.01


def test_what_is_not_measured_is_passed_over() -> None:
    errors = lfilter([1.0], [1.0, -0.9], NEW[0])
    gaps = np.where(np.arange(errors.size) % 500 == 0, np.nan, errors)
    assert autoregression([gaps], 1).reflection == pytest.approx((0.9,), abs=0.01)


def test_errors_that_say_nothing_are_white_and_those_that_run_on_are_held_stable() -> None:
    for nothing in ([np.zeros(50)], [np.full(50, np.nan)], [np.ones(1)], []):
        found = autoregression(nothing, 2)
        assert found.reflection == (0.0, 0.0)
        assert found.level > 0.0
    assert autoregression([np.arange(1e4) ** 2], 1).reflection[0] == pytest.approx(STABLE, abs=1e-4)
    assert WHITE.reflection == ()
