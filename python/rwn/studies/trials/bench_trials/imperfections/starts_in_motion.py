"""A recording that was started when the motor ran already; its time starts from 0, nothing says so."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from rwn.studies.trials.bench_trials.imperfections.imperfection import Imperfection, Instruments, Kind, Rng
from rwn.studies.trials.bench_trials.log import Log


@dataclass(frozen=True, kw_only=True)
class StartsInMotion(Imperfection):
    """The first `share` of the rows is cut off."""

    kind = "starts-in-motion"
    share: float

    @property
    def kept(self) -> float:
        return 1.0 - self.share

    def written(self, log: Log, rng: Rng) -> Log:  # noqa: ARG002
        left = log.rows(np.arange(int(self.share * log.time.size), log.time.size))
        return replace(left, time=left.time - left.time[0])


def _draw(rng: Rng, _: Instruments) -> StartsInMotion:
    return StartsInMotion(share=float(rng.uniform(0.2, 0.5)))


KIND = Kind(name=StartsInMotion.kind, draw=_draw)
