"""Timestamps: written with few digits, or by a clock that runs fast."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from rwn.studies.trials.bench_trials.imperfections.imperfection import Imperfection, Instruments, Kind, Rng
from rwn.studies.trials.bench_trials.log import Log

DIGITS = (1e-3, 1e-4)  # s


@dataclass(frozen=True, kw_only=True)
class RoundedTime(Imperfection):
    """To whole multiples of `step` [s]."""

    kind = "rounded-time"
    step: float

    def written(self, log: Log, rng: Rng) -> Log:  # noqa: ARG002
        digits = round(-np.log10(self.step))
        return replace(log, time=np.round(log.time, digits))


@dataclass(frozen=True, kw_only=True)
class FastClock(Imperfection):
    """The logger's second is shorter than a second, by this share."""

    kind = "fast-clock"
    share: float

    def written(self, log: Log, rng: Rng) -> Log:  # noqa: ARG002
        return replace(log, time=log.time * (1.0 + self.share))


def _visible(rate: float) -> list[float]:
    """The steps below half a sample that do not divide the sample."""
    return [step for step in DIGITS if 0.5 / rate > step and abs((1.0 / rate / step + 0.5) % 1.0 - 0.5) > 0.01]


def _draw(rng: Rng, instruments: Instruments) -> RoundedTime:
    return RoundedTime(step=float(rng.choice(_visible(instruments.rate))))


def _draw_fast(rng: Rng, _: Instruments) -> FastClock:
    return FastClock(share=float(rng.uniform(0.0002, 0.002)))


KIND = Kind(name=RoundedTime.kind, draw=_draw, suits=lambda i: bool(_visible(i.rate)))
FAST = Kind(name=FastClock.kind, draw=_draw_fast)
