"""The chain of a logger: wiring, sensors, electronics, file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from rwn.studies.trials.bench import Noise, Recording
from rwn.studies.trials.bench_trials.imperfections import Imperfection
from rwn.studies.trials.bench_trials.log import Log, counted, opened
from rwn.studies.trials.bench_trials.rig import POSITION, SENSED_CURRENT, SENSED_SPEED, Truth

Rng = np.random.Generator
Stream = Sequence[int]


@dataclass(frozen=True, kw_only=True)
class Logger:
    """What stands between a motor and its file. `quantum` > 0 is the step of a speed sensor that rounds."""

    imperfections: tuple[Imperfection, ...]
    noise: Noise
    signals: tuple[str, ...]
    peaks: Mapping[str, float]
    quantum: float = 0.0

    def record(self, truth: Truth, stream: Stream) -> Recording:
        """What it writes of `truth`.

        Every imperfection draws from a random stream of its own: one of them less changes nothing about the others.
        """
        log = opened(truth, self.noise, self.peaks)
        for each in self.imperfections:
            log = each.wired(log, _rng(stream, each.kind))
        log = self._sensed(log, np.random.default_rng([*stream, 0]))
        for each in self.imperfections:
            log = each.written(log, _rng(stream, each.kind))
        return self._file(log)

    def without_noise(self) -> Logger:
        """One that writes the same rows without noise, rounding and errors."""
        clean = tuple(c for c in (each.without_noise() for each in self.imperfections) if c is not None)
        return replace(self, imperfections=clean, noise=Noise(0.0, 0.0), quantum=0.0)

    def _sensed(self, log: Log, rng: Rng) -> Log:
        """The sensors at the instants of the rows; the voltage is the one commanded at the last tick."""
        truth, noise, rows = log.truth, self.noise, log.when.size
        current = truth.at(SENSED_CURRENT, log.seen("current")) + noise.current * rng.standard_normal(rows)
        position = truth.at(POSITION, log.seen("speed"))
        if noise.counts:
            position = counted(position, noise.counts)
            speed = np.gradient(position, log.when)
        else:
            speed = truth.at(SENSED_SPEED, log.seen("speed")) + noise.speed * rng.standard_normal(rows)
            if self.quantum > 0.0:
                speed = self.quantum * np.round(speed / self.quantum)
        return log.having(voltage=truth.voltage[log.tick], current=current, speed=speed, position=position)

    def _file(self, log: Log) -> Recording:
        return Recording(
            time=log.time,
            voltage=log.signals["voltage"],
            speed=log.signals["speed"],
            current=log.signals["current"] if "i" in self.signals else None,
            position=log.signals["position"] if "th" in self.signals else None,
        )


def _rng(stream: Stream, kind: str) -> Rng:
    return np.random.default_rng([*stream, *kind.encode()])
