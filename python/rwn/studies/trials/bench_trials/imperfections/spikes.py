"""Spikes: single rows where the bus or the converter failed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rwn.studies.trials.bench_trials.imperfections.imperfection import Imperfection, Instruments, Kind, Rng
from rwn.studies.trials.bench_trials.log import Log
from rwn.studies.trials.plant import Array

HEIGHTS = (0.0, 1.5, -1.5)  # of the largest value in the recording


@dataclass(frozen=True, kw_only=True)
class Spikes(Imperfection):
    """A `share` of the rows, of each signal by itself, holds zero or a value beyond full scale."""

    kind = "spikes"
    share: float

    def written(self, log: Log, rng: Rng) -> Log:
        return log.having(**{name: self._spiked(log.signals[name], rng) for name in ("speed", "current")})

    def _spiked(self, x: Array, rng: Rng) -> Array:
        hit = rng.random(x.size) < self.share
        return np.where(hit, float(np.max(np.abs(x))) * rng.choice(HEIGHTS, x.size), x)

    def without_noise(self) -> None:
        return None


def _draw(rng: Rng, _: Instruments) -> Spikes:
    return Spikes(share=float(rng.uniform(0.001, 0.005)))


KIND = Kind(name=Spikes.kind, draw=_draw)
