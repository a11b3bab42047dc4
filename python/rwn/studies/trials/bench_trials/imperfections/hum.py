"""Mains hum on the wires of the sensors."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rwn.studies.trials.bench_trials.imperfections.imperfection import Imperfection, Instruments, Kind, Rng
from rwn.studies.trials.bench_trials.log import Log
from rwn.studies.trials.plant import Array

MAINS = 50.0  # Hz
HARMONICS = (1, 3, 5)


@dataclass(frozen=True, kw_only=True)
class Hum(Imperfection):
    """Rms of each signal's hum over the rms of its noise; 0: none."""

    kind = "hum"
    speed: float
    current: float

    def written(self, log: Log, rng: Rng) -> Log:
        return log.having(
            speed=log.signals["speed"] + self.speed * log.noise.speed * _wave(log.when, rng),
            current=log.signals["current"] + self.current * log.noise.current * _wave(log.when, rng),
        )

    def without_noise(self) -> None:
        return None


def _wave(time: Array, rng: Rng) -> Array:
    """Of rms 1; the harmonics fall, each in a phase of its own."""
    heights = np.array([rng.uniform(0.5, 1.0) / n for n in HARMONICS])
    heights *= np.sqrt(2.0 / np.sum(heights**2))
    turns = MAINS * np.outer(time, HARMONICS)
    return np.asarray(np.sin(2.0 * np.pi * turns + rng.uniform(-np.pi, np.pi, len(HARMONICS))) @ heights)


def _draw(rng: Rng, instruments: Instruments) -> Hum:
    speed = 0.0 if instruments.encoder else float(rng.uniform(0.5, 2.0))  # counts do not hum
    return Hum(speed=speed, current=float(rng.uniform(0.5, 2.0)))


KIND = Kind(name=Hum.kind, draw=_draw, suits=lambda i: "i" in i.signals or not i.encoder)
