"""What is unknown of one run alone: its place in the vector of a fit, behind all parameters, and what it changes."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class StartUnknown(NamedTuple):
    """An unknown of a run's start, which adds to one parameter."""

    place: int  # in the vector
    parameter: int  # index in the core


class LevelPrior(NamedTuple):
    """What is known beforehand of a level that every recording has for itself."""

    parameters: tuple[int, ...]  # indices in the core of what it scales
    spread: float  # deviation of the logarithm of the factor, or of what is added
    adds: bool = False  # it is added

    def of(self, values: Array, level: float) -> Array:
        """Values (p,) of its parameters under a level."""
        return _at(values, level, self.adds)


class LevelShare(NamedTuple):
    """A level that a run has a share of: its parameters are multiplied by exp(share * level), or it adds to them."""

    place: int  # of the level in the vector
    share: float
    parameters: tuple[int, ...]  # indices in the core of what it scales
    adds: bool = False  # share * level is added

    def of(self, values: Array, level: float) -> Array:
        """Values (p,) of its parameters under a level."""
        return _at(values, self.share * level, self.adds)


def _at(values: Array, level: float, adds: bool) -> Array:
    return values + level if adds else values * np.exp(level)
