"""What an imperfection of a recording is: a step in the chain of the logger, with its size."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any, ClassVar

import numpy as np

from rwn.studies.trials.bench_trials.log import Log
from rwn.studies.trials.plant import Values

Rng = np.random.Generator


@dataclass(frozen=True, kw_only=True)
class Instruments:
    """What a draw has to know: the signals ("V", "i", "w", "th"), whether counts make the speed, the clock [Hz].

    `coarse`: few rows per mechanical time constant. `recordings`: how many there are, training ones first.
    """

    signals: tuple[str, ...]
    encoder: bool
    rate: float
    coarse: bool
    recordings: int


@dataclass(frozen=True, kw_only=True)
class Imperfection:
    """The same in every recording of a trial. The fields are its sizes; the hooks do nothing unless it says so."""

    kind: ClassVar[str]

    @property
    def like(self) -> frozenset[str]:
        """Effects of the vocabulary that describe it rightly."""
        return frozenset()

    @property
    def kept(self) -> float:
        """Share of the rows that it leaves."""
        return 1.0

    def off(self, recording: int) -> float:  # noqa: ARG002
        """How long the power stage is off at the beginning of this recording [s]."""
        return 0.0

    def machine(self, recording: int, plant: Values) -> Values:  # noqa: ARG002
        """The machine as it is in this recording."""
        return plant

    def declared(self) -> dict[str, Any]:
        """What whoever runs the bench knows and says of it."""
        return {}

    def wired(self, log: Log, rng: Rng) -> Log:  # noqa: ARG002
        """Before the sensors are read."""
        return log

    def written(self, log: Log, rng: Rng) -> Log:  # noqa: ARG002
        """On what they read, on the way to the file."""
        return log

    def without_noise(self) -> Imperfection | None:
        """What is left of it where nothing is noisy, rounded or wrong."""
        return self

    def sizes(self) -> dict[str, Any]:
        return asdict(self)


@dataclass(frozen=True, kw_only=True)
class Kind:
    """How one is drawn, and with which instruments it is possible."""

    name: str
    draw: Callable[[Rng, Instruments], Imperfection]
    suits: Callable[[Instruments], bool] = lambda _: True
