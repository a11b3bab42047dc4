"""Current and motion sampled by different devices: one comes late."""

from __future__ import annotations

from dataclasses import dataclass, replace

from rwn.studies.trials.bench_trials.imperfections.imperfection import Imperfection, Instruments, Kind, Rng
from rwn.studies.trials.bench_trials.log import Log


@dataclass(frozen=True, kw_only=True)
class LateChannel(Imperfection):
    """`signal` shows what was `samples` of the clock ago; the position goes with the speed."""

    kind = "late-channel"
    signal: str
    samples: float

    @property
    def like(self) -> frozenset[str]:
        if self.signal == "current":
            return frozenset({"current-sensor-delay", "current-sensor-lag"})
        return frozenset({"input-delay", "speed-sensor-delay", "speed-sensor-lag"})

    def wired(self, log: Log, rng: Rng) -> Log:  # noqa: ARG002
        return replace(log, late={**log.late, self.signal: self.samples * log.period})


def _draw(rng: Rng, instruments: Instruments) -> LateChannel:
    current = "i" in instruments.signals and rng.random() < 0.5
    return LateChannel(signal="current" if current else "speed", samples=float(rng.uniform(0.2, 2.0)))


KIND = Kind(name=LateChannel.kind, draw=_draw)
