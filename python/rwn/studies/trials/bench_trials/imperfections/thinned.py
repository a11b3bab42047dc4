"""Every second or third row: the voltage has changed in between."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rwn.studies.trials.bench_trials.imperfections.imperfection import Imperfection, Instruments, Kind, Rng
from rwn.studies.trials.bench_trials.log import Log


@dataclass(frozen=True, kw_only=True)
class Thinned(Imperfection):
    kind = "thinned"
    every: int

    @property
    def kept(self) -> float:
        return 1.0 / self.every

    def written(self, log: Log, rng: Rng) -> Log:  # noqa: ARG002
        return log.rows(np.arange(0, log.time.size, self.every))


def _draw(rng: Rng, _: Instruments) -> Thinned:
    return Thinned(every=int(rng.integers(2, 4)))


KIND = Kind(name=Thinned.kind, draw=_draw, suits=lambda i: not i.coarse)
