"""A linear drive is interpolated exactly, beside steps of its input too; one sample that is off shows as such."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter

from rwn.recording.inspection.outliers import REACH
from rwn.recording.inspection.step_response import interpolated

Array = NDArray[np.float64]


def _steps_and_answer() -> tuple[Array, Array]:
    steps = np.repeat(np.random.default_rng(1).uniform(-1.0, 1.0, 40), 50)
    return steps, lfilter([0.0, 0.3, 0.1], [1.0, -1.2, 0.4], steps)


def test_the_answer_of_two_states_to_steps_is_interpolated_exactly() -> None:
    steps, answer = _steps_and_answer()
    assert np.max(np.abs(interpolated(answer, [steps]).errors)) < 1e-9
    assert np.max(np.abs(interpolated(answer, []).errors)) > 0.01


def test_a_sample_that_is_off_by_itself_is_told_by_the_errors_beside_it() -> None:
    steps, answer = _steps_and_answer()
    spoilt = answer.copy()
    spoilt[951] += 2.0
    off = interpolated(spoilt, [steps])
    beside = off.errors[951 - REACH : 951 + REACH + 1]
    np.testing.assert_allclose(beside, off.errors[951] * off.of_one, atol=1e-3)
    assert np.argmax(np.abs(off.errors)) == 951


def test_too_few_samples_are_not_interpolated() -> None:
    assert not interpolated(np.arange(10.0) ** 2, []).errors.any()
