"""A recording on its way through the logger."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rwn.studies.trials.bench import Noise
from rwn.studies.trials.bench_trials.rig import Truth
from rwn.studies.trials.plant import Array


@dataclass(frozen=True, kw_only=True)
class Log:
    """`when` a row is sampled and the `time` that it is given [s]; `signals` by column of the file, (rows,).

    `peaks` are the largest magnitudes of the training recordings, from which full scales are reckoned. A column that
    is `late` holds what was true that much before [s].
    """

    truth: Truth
    noise: Noise
    peaks: Mapping[str, float]
    when: Array
    time: Array
    signals: Mapping[str, Array] = field(default_factory=dict)
    late: Mapping[str, float] = field(default_factory=dict)

    @property
    def period(self) -> float:
        """From tick to tick of the controller [s]."""
        return 1.0 / self.truth.rate

    def seen(self, signal: str) -> Array:
        """The instants that the rows of a signal show."""
        return self.when - self.late.get(signal, 0.0)

    @property
    def tick(self) -> NDArray[np.int64]:
        """The last tick before each row, or at it."""
        return np.asarray(np.floor(self.when * self.truth.rate + 1e-6), dtype=np.int64)

    def having(self, **signals: Array) -> Log:
        """With these columns instead."""
        return replace(self, signals={**self.signals, **signals})

    def rows(self, kept: NDArray[Any]) -> Log:
        """These rows alone: indices or a mask."""
        signals = {name: values[kept] for name, values in self.signals.items()}
        return replace(self, when=self.when[kept], time=self.time[kept], signals=signals)


def opened(truth: Truth, noise: Noise, peaks: Mapping[str, float]) -> Log:
    """Sampled on the clock, nothing measured yet."""
    clock = np.arange(truth.ticks) / truth.rate
    return Log(truth=truth, noise=noise, peaks=peaks, when=clock, time=clock)


def counted(position: Array, counts: int) -> Array:
    """In whole counts of an encoder with so many per revolution."""
    step = 2.0 * np.pi / counts
    return np.asarray(step * np.floor(position / step))
