"""A voltage that was measured, not commanded."""

from __future__ import annotations

from dataclasses import dataclass

from rwn.studies.trials.bench_trials.imperfections.imperfection import Imperfection, Instruments, Kind, Rng
from rwn.studies.trials.bench_trials.log import Log
from rwn.studies.trials.effects.definition import log_uniform


@dataclass(frozen=True, kw_only=True)
class NoisyVoltage(Imperfection):
    """Rms of its noise over the largest voltage of the training recordings."""

    kind = "noisy-voltage"
    noise: float

    def written(self, log: Log, rng: Rng) -> Log:
        voltage = log.signals["voltage"]
        return log.having(voltage=voltage + self.noise * log.peaks["voltage"] * rng.standard_normal(voltage.size))

    def without_noise(self) -> None:
        return None


def _draw(rng: Rng, _: Instruments) -> NoisyVoltage:
    return NoisyVoltage(noise=log_uniform(rng, 0.001, 0.01))


KIND = Kind(name=NoisyVoltage.kind, draw=_draw)
