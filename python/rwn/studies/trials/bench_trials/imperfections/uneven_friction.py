"""Bearings that run harder in one recording than in the next: warm or cold, loaded or not."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rwn.studies.trials.bench_trials.imperfections.imperfection import Imperfection, Instruments, Kind, Rng
from rwn.studies.trials.effects.definition import log_uniform
from rwn.studies.trials.plant import Values

LEVELS = ("viscous_friction", "load_viscous", "coulomb_plus", "coulomb_minus")


@dataclass(frozen=True, kw_only=True)
class UnevenFriction(Imperfection):
    """Friction of each recording over that of the machine."""

    kind = "uneven-friction"
    factors: tuple[float, ...]

    def machine(self, recording: int, plant: Values) -> Values:
        factor = self.factors[recording]
        return plant | {name: factor * plant[name] for name in LEVELS if name in plant}


def _draw(rng: Rng, instruments: Instruments) -> UnevenFriction:
    spread = log_uniform(rng, 0.01, 0.15)
    return UnevenFriction(factors=tuple(np.exp(spread * rng.standard_normal(instruments.recordings)).tolist()))


KIND = Kind(name=UnevenFriction.kind, draw=_draw)
