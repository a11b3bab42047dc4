"""Steepest descent with momentum over the whole batch (2.20)."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import ClassVar

from numpy.typing import ArrayLike

from rwn import _core
from rwn.networks.arrays import as_pairs
from rwn.networks.conventional_network import ConventionalNetwork
from rwn.networks.training import Training, check_options

_DEFAULTS = _core.trainer_defaults()["gradient-descent"]


@dataclass(frozen=True, kw_only=True)
class GradientDescent:
    """Steps of (2.20) on the mean over patterns of (2.12); the sum, as printed, diverges at every rate of the
    thesis.

    rate: learning rate mu.
    momentum: momentum coefficient gamma, in [0, 1).
    iterations: most updates.
    target: MSE at which to stop.
    stall: relative change of the MSE over 100 iterations below which to stop; -1 never stops.
    """

    name: ClassVar[str] = "gradient-descent"
    rate: float = _DEFAULTS["rate"]
    momentum: float = _DEFAULTS["momentum"]
    iterations: int = _DEFAULTS["iterations"]
    target: float = _DEFAULTS["target"]
    stall: float = _DEFAULTS["stall"]

    def __post_init__(self) -> None:
        check_options(
            iterations=self.iterations, positive={"rate": self.rate}, fractions={"momentum": self.momentum}
        )

    def train(self, network: ConventionalNetwork, x: ArrayLike, y: ArrayLike) -> Training:
        """Trains on inputs x (patterns, inputs) and wanted outputs y (patterns, outputs).

        Raises InputError for arrays of other shapes.
        """
        return Training.of(network, _core.gradient_descent(network.core, *as_pairs(x, y), **asdict(self)))
