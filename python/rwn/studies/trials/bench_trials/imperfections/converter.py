"""Converters with few bits, and one that ends below the current's peak."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rwn.studies.trials.bench_trials.imperfections.imperfection import Imperfection, Instruments, Kind, Rng
from rwn.studies.trials.bench_trials.log import Log
from rwn.studies.trials.plant import Array


@dataclass(frozen=True, kw_only=True)
class CoarseConverter(Imperfection):
    """Bits over +- `full_scale` times the largest value in the training recordings; 0 bits: no converter."""

    kind = "coarse-converter"
    speed_bits: int
    current_bits: int
    full_scale: float

    @property
    def like(self) -> frozenset[str]:
        return frozenset({"sensor-quantization"} if self.speed_bits else ())

    def written(self, log: Log, rng: Rng) -> Log:  # noqa: ARG002
        bits = {"speed": self.speed_bits, "current": self.current_bits}
        scale = {name: self.full_scale * log.peaks[name] for name in bits}
        return log.having(**{n: _converted(log.signals[n], b, scale[n]) for n, b in bits.items() if b})

    def without_noise(self) -> None:
        return None


def _converted(x: Array, bits: int, scale: float) -> Array:
    step = 2.0 * scale / 2**bits
    return np.asarray(step * np.round(np.clip(x, -scale, scale - step) / step))


@dataclass(frozen=True, kw_only=True)
class ClippedCurrent(Imperfection):
    """The current ends at a `share` of its largest value in the training recordings."""

    kind = "clipped-current"
    share: float

    def written(self, log: Log, rng: Rng) -> Log:  # noqa: ARG002
        limit = self.share * log.peaks["current"]
        return log.having(current=np.clip(log.signals["current"], -limit, limit))


def _draw(rng: Rng, instruments: Instruments) -> CoarseConverter:
    speed = 0 if instruments.encoder else int(rng.integers(8, 13))
    return CoarseConverter(
        speed_bits=speed, current_bits=int(rng.integers(8, 13)), full_scale=float(rng.uniform(1.05, 1.6))
    )


def _draw_clipped(rng: Rng, _: Instruments) -> ClippedCurrent:
    return ClippedCurrent(share=float(rng.uniform(0.6, 0.9)))


KIND = Kind(name=CoarseConverter.kind, draw=_draw, suits=lambda i: "i" in i.signals or not i.encoder)
CLIPPED = Kind(name=ClippedCurrent.kind, draw=_draw_clipped, suits=lambda i: "i" in i.signals)
