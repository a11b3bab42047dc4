"""The independent plant: runs of `cpp/plant/plant.cpp`, which the diagnosing model never uses."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rwn.studies.trials import _plant

Array = NDArray[np.float64]
Values = dict[str, float]

PARAMETERS: frozenset[str] = frozenset(_plant.parameter_names())


@dataclass(frozen=True)
class Effort:
    """Least number of integration steps per sample, and largest step times the plant's fastest rate."""

    substeps: int
    fineness: float


TRUTH = Effort(substeps=24, fineness=0.15)  # for recordings
FIT = Effort(substeps=4, fineness=1.0)  # for the many runs of a refit


@dataclass(frozen=True)
class Trace:
    """A run without noise; arrays (rows,), SI units. `sensed_*` is what ideal electronics would record."""

    voltage: Array
    current: Array
    speed: Array
    position: Array
    sensed_current: Array
    sensed_speed: Array
    temperature_rise: Array

    @classmethod
    def of(cls, voltage: Array, rows: Array) -> Trace:
        return cls(voltage, *np.ascontiguousarray(rows.T))


def check(parameters: Mapping[str, float]) -> Values:
    """Refuses names that the plant does not know and values that are not numbers."""
    unknown = sorted(set(parameters) - PARAMETERS)
    if unknown:
        raise ValueError(f"plant parameters {unknown} are not known; use names of {sorted(PARAMETERS)}")
    wrong = sorted(name for name, value in parameters.items() if np.isnan(value))
    if wrong:
        raise ValueError(f"plant parameters {wrong} are not numbers; give a value in SI units")
    return dict(parameters)


def simulate(
    parameters: Mapping[str, float], voltage: Array, *, rate: float, effort: Effort = TRUTH
) -> Trace:
    """Runs the plant from rest under `voltage` (rows,) [V], each value held from its row to the next.

    Raises ValueError for an unknown parameter or one without physical sense.
    """
    held = np.ascontiguousarray(voltage, dtype=np.float64)
    rows = _plant.run(check(parameters), held, 1.0 / rate, effort.substeps, effort.fineness)
    return Trace.of(held, rows)


class Bench:
    """The plant one sample at a time, for controllers in the loop."""

    def __init__(self, parameters: Mapping[str, float], *, rate: float, voltage_scale: float) -> None:
        self._plant = _plant.Plant(
            check(parameters), 1.0 / rate, voltage_scale, TRUTH.substeps, TRUTH.fineness
        )

    def sample(self) -> list[float]:
        """(current, speed, position, sensed current, sensed speed, temperature rise) now."""
        return list(self._plant.sample())

    def step(self, voltage: float) -> None:
        self._plant.step(voltage)
