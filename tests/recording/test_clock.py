"""When samples were taken: step, jitter and lost rows are told apart."""

from __future__ import annotations

import numpy as np
import pytest

from rwn.recording.inspection.clock import clock


def test_an_even_clock_has_no_jitter_and_no_lost_rows() -> None:
    at = clock(np.arange(100) * 0.002)
    assert at.step == pytest.approx(0.002)
    assert not at.irregular
    assert at.lost == 0


def test_lost_rows_are_counted_and_are_no_jitter() -> None:
    at = clock(np.delete(np.arange(100) * 0.002, [20, 21, 22, 50]))
    assert at.lost == 4
    assert not at.irregular


def test_jitter_is_that_of_the_steps() -> None:
    steps = np.where(np.arange(100) % 2, 0.0011, 0.0009)
    at = clock(np.cumsum(steps))
    assert at.jitter == pytest.approx(0.1, abs=0.01)
    assert at.lost == 0
