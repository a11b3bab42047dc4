"""The clock that rows were sampled by."""

from __future__ import annotations

import numpy as np
import pytest

from rwn.recording.check import _check_time
from rwn.recording.clock import clock_of


def test_jittered_rows_with_gaps_are_counted_by_their_clock() -> None:
    rng = np.random.default_rng(3)
    ticks = np.delete(np.arange(2000), [5, 6, 700])
    off = rng.uniform(-0.25, 0.25, ticks.size)
    clock = clock_of(10.0 + 2e-3 * (ticks + off))
    assert clock.period == pytest.approx(2e-3, rel=1e-5)
    assert clock.lost == 3
    assert np.array_equal(clock.ticks, ticks)
    assert clock.jitter == pytest.approx(np.std(off), rel=0.02)
    assert clock.off - np.mean(clock.off) == pytest.approx(off - np.mean(off), abs=0.01)


@pytest.mark.parametrize("reach", [0.25, 0.3, 0.4])
@pytest.mark.parametrize("rows", [400, 4000])
def test_rows_far_beside_their_ticks_are_counted_too(reach: float, rows: int) -> None:
    """The first rows alone do not tell the period well enough to count by."""
    rng = np.random.default_rng(rows)
    kept = np.flatnonzero(np.append(True, rng.uniform(size=rows - 1) > 0.01))
    clock = clock_of(3.0 + 5e-3 * (kept + rng.uniform(-reach, reach, kept.size)))
    assert np.array_equal(clock.ticks, kept)


def test_a_perfect_clock_has_no_jitter() -> None:
    clock = clock_of(0.5 + 1e-3 * np.arange(100))
    assert clock.lost == 0
    assert clock.jitter < 1e-9
    assert clock.start == pytest.approx(0.5)


def test_a_clock_that_is_asked_for_again_is_not_looked_for_again() -> None:
    time = 1e-3 * np.arange(500)
    assert clock_of(time) is clock_of(time.copy())
    with pytest.raises(ValueError, match="read-only"):
        clock_of(time).ticks[0] = 1


def test_rows_without_a_clock_count_as_one_each() -> None:
    clock = clock_of(np.cumsum(np.random.default_rng(4).exponential(1e-3, 200)))
    assert clock.lost == 0
    assert clock.jitter > 0.5


@pytest.mark.parametrize("lost", [0, 50])
@pytest.mark.parametrize("period", [1.6e-3, 2.5e-3, 3.2e-3, 6.4e-3])
def test_a_clock_is_found_behind_times_that_are_written_in_milliseconds(period: float, lost: int) -> None:
    ticks = np.arange(5000)
    ticks = np.delete(ticks, np.random.default_rng(0).choice(np.arange(1, 4999), lost, replace=False))
    clock = clock_of(np.round(period * ticks, 3))
    assert clock.period == pytest.approx(period, rel=1e-6)
    assert clock.lost == lost


def test_rows_far_behind_their_ticks_keep_their_own() -> None:
    """Delays of a computer that are half-normal: of a row in twenty another tick is nearer than its own."""
    rng = np.random.default_rng(4)
    ticks = np.flatnonzero(rng.random(3000) > 0.01)
    late = np.minimum(np.abs(rng.normal(0.0, 0.25, ticks.size)), 0.85)
    clock = clock_of(0.01 * (ticks + late))
    assert np.mean(clock.ticks == ticks - ticks[0]) > 0.999
    assert clock.period == pytest.approx(0.01, rel=1e-5)


def test_rows_that_catch_up_with_an_overrun_keep_their_ticks() -> None:
    """A loop that stood for five periods and then ran its late rows one after the other."""
    ticks = np.arange(2000, dtype=float)
    time = ticks + 0.01 * np.random.default_rng(6).standard_normal(2000)
    time[700:706] = 704.6 + 0.1 * np.arange(6)
    assert np.array_equal(clock_of(0.005 * time).ticks, ticks)


def test_rows_at_random_times_have_no_clock() -> None:
    time = np.sort(np.random.default_rng(5).uniform(0.0, 10.0, 1000))
    assert clock_of(time).lost == 0


def test_late_rows_are_not_said_to_be_missing() -> None:
    ticks = np.arange(1000, dtype=float)
    late = 0.02 * np.abs(np.random.default_rng(7).standard_normal(1000))
    late[500:502] = 1.9, 0.95  # the next one follows at once
    assert _check_time(0.01 * (ticks + late), str) == ()
    assert _check_time(np.delete(0.01 * (ticks + late), [700, 701, 702]), str)
