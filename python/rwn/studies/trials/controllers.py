"""What commands the voltage of a recording, tick by tick."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from rwn.studies.trials.plant import Array


class Controller(Protocol):
    """Commands a voltage at every tick; `ceiling` is the largest magnitude."""

    @property
    def ceiling(self) -> float: ...

    def command(self, tick: int, speed: float) -> float:
        """The voltage from this tick to the next, where the rotor turns at `speed` now [V]."""


class Playback:
    """A voltage that was made before."""

    def __init__(self, voltage: Array) -> None:
        self.voltage = voltage

    @property
    def ceiling(self) -> float:
        return float(np.max(np.abs(self.voltage)))

    def command(self, tick: int, _: float) -> float:
        return float(self.voltage[tick])


class SpeedLoop:
    """PI with anti-windup and a clipped output on the true speed (the drive's own tachometer)."""

    def __init__(self, reference: Array, gains: tuple[float, float], ceiling: float, rate: float) -> None:
        self.ceiling = ceiling
        self._reference, self._rate = reference, rate
        self._proportional, self._integral = gains
        self._memory = 0.0

    def command(self, tick: int, speed: float) -> float:
        error = self._reference[tick] - speed
        free = self._proportional * error + self._memory
        voltage = as_written(min(max(free, -self.ceiling), self.ceiling))
        if abs(free) <= self.ceiling or free * error < 0.0:
            self._memory += self._integral * error / self._rate
        return voltage


def as_written(voltage: float) -> float:
    """As a CSV file gives it back: seven figures."""
    return float(f"{voltage:.7g}")


def shaped(voltage: Array) -> Array:
    """The same of an array."""
    return np.array([as_written(value) for value in voltage])
