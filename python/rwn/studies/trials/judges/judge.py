"""What a judge is: an independent simulation of a motor whose physics is known, tick by tick of its controller."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from rwn.studies.trials.plant import Values

FINE = 8  # states that a judge reports per tick
State = Sequence[float]  # current, speed, position, sensed current, sensed speed, temperature rise


class Run(Protocol):
    """One run, from rest at position 0 with a cold winding."""

    def state(self) -> State:
        """What is true now, and what ideal sensors say."""

    def step(self, voltage: float) -> Sequence[State]:
        """Holds `voltage` for a tick; returns the states at its FINE instants, the first at its beginning."""

    def wait(self) -> None:
        """A tick with the power stage off and the rotor held: time goes on, nothing moves."""


class Judge(Protocol):
    """A simulator of the parameter sets of `rwn.studies.trials.plant`."""

    @property
    def name(self) -> str: ...

    def missing(self) -> str:
        """What keeps it from running here, in one line; empty where nothing does."""

    def knows(self, effect: str) -> bool:
        """Whether it has the law of this effect."""

    def describes(self, plant: Values) -> bool:
        """Whether it has every law of this parameter set."""

    def start(self, plant: Values, *, rate: float, voltage_scale: float) -> Run:
        """A run at a clock of `rate` [Hz]; `voltage_scale` is the largest voltage to expect."""
