"""A speed that the drive makes from encoder counts: their backward difference, smoothed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.signal import lfilter

from rwn.studies.trials.bench_trials.imperfections.drive_filter import first_order
from rwn.studies.trials.bench_trials.imperfections.imperfection import Imperfection, Instruments, Kind, Rng
from rwn.studies.trials.bench_trials.log import Log, counted
from rwn.studies.trials.bench_trials.rig import POSITION
from rwn.studies.trials.effects.definition import log_uniform

COUNTS = (500, 512, 1000, 1024, 2000, 2048, 4000)  # per revolution


@dataclass(frozen=True, kw_only=True)
class EncoderDifference(Imperfection):
    """`window` rows of a moving average, or else the time constant `filter` of a first-order one [samples]."""

    kind = "encoder-difference"
    counts: int
    window: int = 0
    filter: float = 0.0

    @property
    def like(self) -> frozenset[str]:
        # a difference of positions is the mean of the speed since, as is a moving average of differences
        return frozenset({"speed-moving-average", "speed-sensor-lag", "input-delay", "sensor-quantization"})

    def speed_error(self, rate: float) -> float:
        """Rms of the rounding in the speed [rad/s]: what is rounded is evenly spread over a count."""
        rounding = 2.0 * np.pi / self.counts * rate / np.sqrt(12.0)
        if self.window:
            return float(rounding * np.sqrt(2.0) / self.window)
        gain = 1.0 - np.exp(-1.0 / self.filter)
        return float(rounding * gain * np.sqrt(2.0 / (2.0 - gain)))

    def written(self, log: Log, rng: Rng) -> Log:  # noqa: ARG002
        true = log.truth.at(POSITION, log.seen("speed"))
        position = counted(true, self.counts) if self.counts else true
        raw = np.diff(position, prepend=position[0]) / log.period
        if self.window:
            return log.having(position=position, speed=lfilter(np.full(self.window, 1.0 / self.window), [1.0], raw))
        return log.having(position=position, speed=first_order(raw, self.filter))

    def without_noise(self) -> EncoderDifference:
        return EncoderDifference(counts=0, window=self.window, filter=self.filter)


def _draw(rng: Rng, _: Instruments) -> EncoderDifference:
    counts = int(rng.choice(COUNTS))
    if rng.random() < 0.5:
        return EncoderDifference(counts=counts, window=int(rng.integers(2, 9)))
    return EncoderDifference(counts=counts, filter=log_uniform(rng, 0.7, 4.0))


KIND = Kind(name=EncoderDifference.kind, draw=_draw)
