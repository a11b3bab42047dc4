"""Rows that never reached the file."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rwn.studies.trials.bench_trials.imperfections.imperfection import Imperfection, Instruments, Kind, Rng
from rwn.studies.trials.bench_trials.log import Log


def some_lost(rows: int, share: float, rng: Rng) -> NDArray[np.bool_]:
    """True for the rows that are kept, the first among them."""
    kept = rng.random(rows) >= share
    kept[0] = True
    return np.asarray(kept)


@dataclass(frozen=True, kw_only=True)
class LostRows(Imperfection):
    kind = "lost-rows"
    share: float

    def written(self, log: Log, rng: Rng) -> Log:
        return log.rows(some_lost(log.time.size, self.share, rng))


def _draw(rng: Rng, _: Instruments) -> LostRows:
    return LostRows(share=float(rng.uniform(0.005, 0.02)))


KIND = Kind(name=LostRows.kind, draw=_draw)
