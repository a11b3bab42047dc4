"""Sensors whose scale is a little off, by what their data sheets allow."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from rwn.studies.trials.bench_trials.imperfections.imperfection import Imperfection, Instruments, Kind, Rng
from rwn.studies.trials.bench_trials.log import Log
from rwn.studies.trials.effects.definition import log_uniform

CLASSES = (0.001, 0.01)  # one standard deviation of a sensor's scale, as its data sheet states it


@dataclass(frozen=True, kw_only=True)
class GainError(Imperfection):
    """Relative errors of the scales of speed and current, and the standard deviation that is stated of them."""

    kind = "gain-error"
    speed: float
    current: float
    stated: float

    def declared(self) -> dict[str, Any]:
        return {"gain_uncertainty": self.stated}

    def written(self, log: Log, rng: Rng) -> Log:  # noqa: ARG002
        return log.having(
            speed=log.signals["speed"] * (1.0 + self.speed), current=log.signals["current"] * (1.0 + self.current)
        )


def _draw(rng: Rng, instruments: Instruments) -> GainError:
    stated = log_uniform(rng, *CLASSES)
    speed, current = (stated * float(min(max(x, -2.0), 2.0)) for x in rng.standard_normal(2))
    return GainError(speed=0.0 if instruments.encoder else speed, current=current, stated=stated)  # counts are exact


KIND = Kind(name=GainError.kind, draw=_draw, suits=lambda i: "i" in i.signals or not i.encoder)
