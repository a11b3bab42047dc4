"""Sensors that do not read zero at zero."""

from __future__ import annotations

from dataclasses import dataclass

from rwn.studies.trials.bench_trials.imperfections.imperfection import Imperfection, Instruments, Kind, Rng
from rwn.studies.trials.bench_trials.log import Log
from rwn.studies.trials.effects.definition import log_uniform


@dataclass(frozen=True, kw_only=True)
class ZeroOffset(Imperfection):
    """Readings of speed and current at zero, over the rms of their noise."""

    kind = "zero-offset"
    speed: float
    current: float

    @property
    def like(self) -> frozenset[str]:
        return frozenset({"sensor-bias"} if self.speed or self.current else ())

    def written(self, log: Log, rng: Rng) -> Log:  # noqa: ARG002
        return log.having(
            speed=log.signals["speed"] + self.speed * log.noise.speed,
            current=log.signals["current"] + self.current * log.noise.current,
        )


def _draw(rng: Rng, instruments: Instruments) -> ZeroOffset:
    speed, current = (log_uniform(rng, 0.3, 5.0) * float(rng.choice([-1.0, 1.0])) for _ in range(2))
    return ZeroOffset(speed=0.0 if instruments.encoder else speed, current=current)  # counts have no zero


KIND = Kind(name=ZeroOffset.kind, draw=_draw, suits=lambda i: "i" in i.signals or not i.encoder)
