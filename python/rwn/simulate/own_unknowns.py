"""What is unknown of one run alone: its place in the vector of a fit, behind all parameters, and what it changes."""

from __future__ import annotations

from typing import NamedTuple


class StartUnknown(NamedTuple):
    """An unknown of a run's start, which adds to one parameter."""

    place: int  # in the vector
    parameter: int  # index in the core


class LevelShare(NamedTuple):
    """A level that a run has a share of: its parameters are multiplied by exp(share * level)."""

    place: int  # of the level in the vector
    share: float
    parameters: tuple[int, ...]  # indices in the core of what it scales
