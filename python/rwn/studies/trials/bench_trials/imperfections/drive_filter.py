"""A drive's own trace: speed and current behind first-order filters, through which the noise went too."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.signal import lfilter

from rwn.studies.trials.bench_trials.imperfections.imperfection import Imperfection, Instruments, Kind, Rng
from rwn.studies.trials.bench_trials.log import Log
from rwn.studies.trials.effects.definition import log_uniform
from rwn.studies.trials.plant import Array


def first_order(x: Array, samples: float) -> Array:
    """y += (1 - exp(-1 / samples)) (x - y), from the first value on; `samples` is the time constant."""
    gain = 1.0 - np.exp(-1.0 / samples)
    filtered, _ = lfilter([gain], [1.0, gain - 1.0], x, zi=[(1.0 - gain) * x[0]])
    return np.asarray(filtered)


@dataclass(frozen=True, kw_only=True)
class DriveFilter(Imperfection):
    """Time constants in samples."""

    kind = "drive-filter"
    speed: float
    current: float

    @property
    def like(self) -> frozenset[str]:
        return frozenset({"speed-sensor-lag", "current-sensor-lag", "input-delay"})

    def written(self, log: Log, rng: Rng) -> Log:  # noqa: ARG002
        return log.having(
            speed=first_order(log.signals["speed"], self.speed),
            current=first_order(log.signals["current"], self.current),
        )


def _draw(rng: Rng, _: Instruments) -> DriveFilter:
    return DriveFilter(speed=log_uniform(rng, 0.5, 4.0), current=log_uniform(rng, 0.3, 2.0))


KIND = Kind(name=DriveFilter.kind, draw=_draw)
