"""Values that a slow bus brings anew every few rows only."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rwn.recording.signals import MOTION
from rwn.studies.trials.bench_trials.imperfections.imperfection import Imperfection, Instruments, Kind, Rng
from rwn.studies.trials.bench_trials.log import Log
from rwn.studies.trials.plant import Array


@dataclass(frozen=True, kw_only=True)
class Held(Imperfection):
    """Rows from update to update of the motion and of the current; 1 is every row."""

    kind = "values-held"
    speed: int
    current: int

    @property
    def like(self) -> frozenset[str]:
        motion = {"speed-sensor-lag", "input-delay"} if self.speed > 1 else set()
        return frozenset(motion | ({"current-sensor-lag"} if self.current > 1 else set()))

    def written(self, log: Log, rng: Rng) -> Log:  # noqa: ARG002
        every = dict.fromkeys(MOTION, self.speed) | {"current": self.current}
        return log.having(**{name: _held(log.signals[name], rows) for name, rows in every.items()})


def _held(x: Array, rows: int) -> Array:
    k = np.arange(x.size)
    return np.asarray(x[k - k % rows])


def _draw(rng: Rng, instruments: Instruments) -> Held:
    rows = int(rng.integers(2, 9))
    if "i" not in instruments.signals:
        return Held(speed=rows, current=1)
    speed, current = [(rows, 1), (1, rows), (rows, rows)][int(rng.choice(3, p=[0.5, 0.2, 0.3]))]
    return Held(speed=speed, current=current)


KIND = Kind(name=Held.kind, draw=_draw, suits=lambda i: not i.coarse)
