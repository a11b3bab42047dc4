"""Sums of floats that are the same to the last bit in every version of Python."""

from __future__ import annotations

import operator
from collections.abc import Iterable
from functools import reduce


def total(values: Iterable[float]) -> float:
    """Sum of floats, added in their order; the builtin compensates what is rounded off from Python 3.12 on."""
    return reduce(operator.add, values, 0.0)
