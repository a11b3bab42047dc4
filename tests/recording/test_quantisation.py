"""The steps of encoder counts and of coarse converters, and signals without steps."""

from __future__ import annotations

import numpy as np
import pytest

from rwn.recording.quantisation import quantum

TIME = np.arange(4000) * 1e-3
ANGLE = 200.0 * TIME - 30.0 * np.sin(8.0 * TIME)


def test_encoder_counts_are_found_where_no_value_repeats() -> None:
    counts = 4096
    step = 2.0 * np.pi / counts
    seen = step * np.floor(ANGLE / step)
    assert np.unique(seen).size > seen.size / 3
    assert quantum(np.round(seen, 9)) == pytest.approx(step, rel=1e-7)


def test_the_steps_of_a_coarse_converter_are_found() -> None:
    coarse = 2.337 * np.round(np.gradient(ANGLE, 1e-3) / 2.337)
    assert quantum(coarse) == pytest.approx(2.337)


def test_steps_on_the_edge_of_two_last_digits_are_steps() -> None:
    """78.125 rpm written with six digits: 8359.375 stands there as 8359.37 and as 8359.38."""
    counts = 78.125 * np.round(np.gradient(ANGLE, 1e-3) / 4.0)
    written = np.array([float(f"{x + d:.6g}") for x, d in zip(counts, 1e-9 * (-1.0) ** np.arange(4000), strict=True)])
    assert np.unique(written).size > 1.2 * np.unique(counts).size
    assert quantum(written) == pytest.approx(78.125, rel=1e-5)


@pytest.mark.parametrize("step", [10.41666, 1.63])
def test_steps_written_with_one_decimal_are_steps(step: float) -> None:
    """31.25 rpm, three counts in 4 ms, stands there as 31.2 and as 31.3."""
    counts = np.round(np.gradient(ANGLE, 1e-3) * 9.55 / step)
    written = np.round(step * counts + 1e-9 * (-1.0) ** np.arange(4000), 1)
    assert quantum(written / 9.55) == pytest.approx(step / 9.55, rel=1e-3)


def test_the_decimals_of_a_file_are_no_steps() -> None:
    rng = np.random.default_rng(0)
    assert quantum(np.round(100.0 * rng.standard_normal(4000), 3)) == 0.0
    assert quantum(100.0 * rng.standard_normal(4000)) == 0.0


def test_a_handful_of_samples_says_nothing_about_steps() -> None:
    stairs = 0.25 * np.arange(20.0)
    assert quantum(np.repeat(stairs, 4)) == pytest.approx(0.25)
    assert quantum(stairs[:19]) == 0.0
