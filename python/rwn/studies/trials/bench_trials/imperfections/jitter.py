"""A logger that samples beside the controller's clock, and says when."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from rwn.studies.trials.bench_trials.imperfections.imperfection import Imperfection, Instruments, Kind, Rng
from rwn.studies.trials.bench_trials.imperfections.lost_rows import some_lost
from rwn.studies.trials.bench_trials.log import Log
from rwn.studies.trials.plant import Array


@dataclass(frozen=True, kw_only=True)
class _Jitter(Imperfection):
    """Off the clock by up to `reach` samples, and a share `lost` of the rows is missing."""

    reach: float
    lost: float

    def _instants(self, log: Log, rng: Rng) -> Array:
        """The first row stays where it is, none is later than the last tick."""
        off = self.reach * rng.uniform(-1.0, 1.0, log.when.size) * log.period
        off[0] = 0.0
        return np.asarray(np.minimum(log.when + off, log.when[-1]))


@dataclass(frozen=True, kw_only=True)
class Jitter(_Jitter):
    """With sensors of its own: a row holds what is true at its instant, with noise of its own."""

    kind = "jitter"

    def wired(self, log: Log, rng: Rng) -> Log:
        instants = self._instants(log, rng)
        kept = some_lost(instants.size, self.lost, rng)
        return replace(log, when=instants, time=instants).rows(kept)


@dataclass(frozen=True, kw_only=True)
class ResampledJitter(_Jitter):
    """From the drive's rows: a row lies on the line between its neighbours; the voltage is that of the last tick."""

    kind = "resampled-jitter"

    def written(self, log: Log, rng: Rng) -> Log:
        instants = self._instants(log, rng)
        lines = {
            name: np.interp(instants, log.when, values)
            for name, values in log.signals.items()
            if name != "voltage"
        }
        moved = replace(log, when=instants, time=instants)
        held = log.signals["voltage"][moved.tick]
        return moved.having(voltage=held, **lines).rows(some_lost(instants.size, self.lost, rng))


def _sizes(rng: Rng) -> dict[str, float]:
    reach = rng.uniform(0.15, 0.25) if rng.random() < 0.75 else rng.uniform(0.25, 0.4)
    return {"reach": float(reach), "lost": float(rng.uniform(0.005, 0.02))}


def _draw(rng: Rng, _: Instruments) -> Jitter:
    return Jitter(**_sizes(rng))


def _draw_resampled(rng: Rng, _: Instruments) -> ResampledJitter:
    return ResampledJitter(**_sizes(rng))


KIND = Kind(name=Jitter.kind, draw=_draw)
RESAMPLED = Kind(name=ResampledJitter.kind, draw=_draw_resampled)
