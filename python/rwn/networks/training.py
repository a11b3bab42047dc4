"""What every trainer of a static network returns."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Protocol

from numpy.typing import ArrayLike

from rwn import _core
from rwn.networks.arrays import Array, read_only
from rwn.networks.conventional_network import ConventionalNetwork


@dataclass(frozen=True, eq=False)
class Training:
    """A finished training.

    `status` is `converged` (target or minimum reached), `iteration-limit`, `stalled` or `diverged`; `advice`
    says what to try. `mse` (iterations,) is the history; for `pattern-descent` it is the tracking error met
    while learning, and `frozen_mse` the error of `network` with its weights held. Of a diverged run
    `network` is the best one met.
    """

    network: ConventionalNetwork
    mse: Array
    frozen_mse: float
    status: str
    advice: str

    @classmethod
    def of(cls, start: ConventionalNetwork, core: _core.Training) -> Training:
        """From the core's result for a network of the shape of `start`."""
        network = start.with_parameters(core.parameters)
        return cls(network, read_only(core.mse), core.frozen_mse, core.status, core.advice)


class Trainer(Protocol):
    """A trainer: an immutable set of options with a name."""

    name: ClassVar[str]

    def train(self, network: ConventionalNetwork, x: ArrayLike, y: ArrayLike) -> Training:
        """Trains on inputs x (patterns, inputs) and wanted outputs y (patterns, outputs)."""
        ...


def check_options(
    *,
    iterations: int,
    positive: dict[str, float],
    fractions: dict[str, float] | None = None,
    beta: float = 2.0,
) -> None:
    """Raises ValueError for an option that is not positive, not in [0, 1), a beta of 1 or less, negative
    iterations."""
    for option, value in positive.items():
        if not value > 0:
            raise ValueError(f"{option} must be positive, got {value}")
    for option, value in (fractions or {}).items():
        if not 0 <= value < 1:
            raise ValueError(f"{option} must be in [0, 1), got {value}")
    if not beta > 1:
        raise ValueError(f"beta must be above 1, got {beta}")
    if iterations < 0:
        raise ValueError(f"iterations must not be negative, got {iterations}")
