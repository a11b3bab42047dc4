"""Noise that is not white: slow electronics, loose couplings, a converter's flicker."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.signal import lfilter

from rwn.studies.trials.bench_trials.imperfections.imperfection import Imperfection, Instruments, Kind, Rng
from rwn.studies.trials.bench_trials.log import Log
from rwn.studies.trials.effects.definition import log_uniform
from rwn.studies.trials.plant import Array


@dataclass(frozen=True, kw_only=True)
class ColouredNoise(Imperfection):
    """First-order noise beside the white: rms over that of the white, and correlation time [samples]."""

    kind = "coloured-noise"
    speed: float
    current: float
    samples: float

    def written(self, log: Log, rng: Rng) -> Log:
        return log.having(
            speed=log.signals["speed"] + self.speed * log.noise.speed * self._noise(log.when.size, rng),
            current=log.signals["current"] + self.current * log.noise.current * self._noise(log.when.size, rng),
        )

    def without_noise(self) -> None:
        return None

    def _noise(self, rows: int, rng: Rng) -> Array:
        """Of rms 1, from the first row on."""
        memory = float(np.exp(-1.0 / self.samples))
        white = rng.standard_normal(rows) * np.sqrt(1.0 - memory**2)
        white[:1] /= np.sqrt(1.0 - memory**2)
        return np.asarray(lfilter([1.0], [1.0, -memory], white))


def _draw(rng: Rng, instruments: Instruments) -> ColouredNoise:
    speed, current = (log_uniform(rng, 0.3, 1.5) for _ in range(2))
    return ColouredNoise(
        speed=0.0 if instruments.encoder else speed, current=current, samples=log_uniform(rng, 2.0, 40.0)
    )


KIND = Kind(name=ColouredNoise.kind, draw=_draw, suits=lambda i: "i" in i.signals or not i.encoder)
