"""The plant of cpp/plant as judge: it has every law."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from rwn.studies.trials import _plant
from rwn.studies.trials.judges.judge import FINE, State
from rwn.studies.trials.plant import TRUTH, Values, check


class OwnRun:
    def __init__(self, plant: Values, *, rate: float, voltage_scale: float) -> None:
        self._plant = _plant.Plant(check(plant), 1.0 / rate, voltage_scale, TRUTH.substeps, TRUTH.fineness)

    def state(self) -> State:
        return self._plant.sample()

    def step(self, voltage: float) -> Sequence[State]:
        return self._plant.step(voltage, FINE)

    def wait(self) -> None:
        self._plant.wait()


@dataclass(frozen=True)
class OwnPlant:
    name: str = "plant"

    def missing(self) -> str:
        return ""

    def knows(self, _: str) -> bool:
        return True

    def describes(self, _: Values) -> bool:
        return True

    def start(self, plant: Values, *, rate: float, voltage_scale: float) -> OwnRun:
        return OwnRun(plant, rate=rate, voltage_scale=voltage_scale)
