"""Steepest descent with momentum after every pattern (2.20): the online training of the thesis."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import ClassVar

from numpy.typing import ArrayLike

from rwn import _core
from rwn.networks.arrays import as_pairs
from rwn.networks.conventional_network import ConventionalNetwork
from rwn.networks.training import Training, check_options

_DEFAULTS = _core.trainer_defaults()["pattern-descent"]


@dataclass(frozen=True, kw_only=True)
class PatternDescent:
    """Steps of (2.20) after every pattern, in the order given. Its history is a tracking error; see
    `Training.frozen_mse`.

    rate: learning rate mu.
    momentum: momentum coefficient of b, a and w, in [0, 1).
    shape_momentum: momentum coefficient of translations and dilations, in [0, 1).
    iterations: most passes over the patterns.
    target: MSE at which to stop.
    stall: relative change of the MSE over 100 iterations below which to stop; -1 never stops.
    """

    name: ClassVar[str] = "pattern-descent"
    rate: float = _DEFAULTS["rate"]
    momentum: float = _DEFAULTS["momentum"]
    shape_momentum: float = _DEFAULTS["shape_momentum"]
    iterations: int = _DEFAULTS["iterations"]
    target: float = _DEFAULTS["target"]
    stall: float = _DEFAULTS["stall"]

    def __post_init__(self) -> None:
        fractions = {"momentum": self.momentum, "shape_momentum": self.shape_momentum}
        check_options(iterations=self.iterations, positive={"rate": self.rate}, fractions=fractions)

    def train(self, network: ConventionalNetwork, x: ArrayLike, y: ArrayLike) -> Training:
        """Trains on inputs x (patterns, inputs) and wanted outputs y (patterns, outputs).

        Raises InputError for arrays of other shapes.
        """
        return Training.of(network, _core.pattern_descent(network.core, *as_pairs(x, y), **asdict(self)))
