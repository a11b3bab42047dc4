"""A power stage that is enabled after the recording has begun: a voltage is commanded, nothing moves."""

from __future__ import annotations

from dataclasses import dataclass

from rwn.studies.trials.bench_trials.imperfections.imperfection import Imperfection, Instruments, Kind, Rng


@dataclass(frozen=True, kw_only=True)
class LateEnable(Imperfection):
    """For how long it is off, in each recording [s]; 0: on from the beginning."""

    kind = "late-enable"
    durations: tuple[float, ...]

    def off(self, recording: int) -> float:
        return self.durations[recording]


def _draw(rng: Rng, instruments: Instruments) -> LateEnable:
    late = rng.random(instruments.recordings) < 0.6
    late[int(rng.integers(instruments.recordings))] = True
    return LateEnable(durations=tuple(float(rng.uniform(0.05, 0.3)) * bool(each) for each in late))


KIND = Kind(name=LateEnable.kind, draw=_draw)
