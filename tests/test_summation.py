"""A sum of floats has the same last bit in every version of Python."""

from __future__ import annotations

import math

from rwn.summation import total


def test_what_is_rounded_off_is_not_compensated() -> None:
    assert total([1.0, 1e16, -1e16]) == 0.0  # sum(), which compensates from Python 3.12 on, has 1.0 there
    assert total([0.1] * 10) == 0.9999999999999999 != math.fsum([0.1] * 10)


def test_of_nothing_it_is_zero_and_what_ran_away_stays_so() -> None:
    assert total([]) == 0.0
    assert total([1e308, 1e308]) == math.inf
