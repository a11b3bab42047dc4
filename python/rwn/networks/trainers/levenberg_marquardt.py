"""Levenberg-Marquardt on all parameters (2.22-2.24)."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import ClassVar

from numpy.typing import ArrayLike

from rwn import _core
from rwn.networks.arrays import as_pairs
from rwn.networks.conventional_network import ConventionalNetwork
from rwn.networks.training import Training, check_options

_DEFAULTS = _core.trainer_defaults()["levenberg-marquardt"]


@dataclass(frozen=True, kw_only=True)
class LevenbergMarquardt:
    """dtheta = (J^T J + mu I)^-1 J^T e; mu is divided by beta after a step that lowers the error, multiplied
    after one that does not.

    mu: first damping.
    beta: factor of the damping, above 1.
    iterations: most Jacobians.
    target: MSE at which to stop.
    stall: relative change of the MSE over 100 iterations below which to stop; -1 never stops.
    """

    name: ClassVar[str] = "levenberg-marquardt"
    mu: float = _DEFAULTS["mu"]
    beta: float = _DEFAULTS["beta"]
    iterations: int = _DEFAULTS["iterations"]
    target: float = _DEFAULTS["target"]
    stall: float = _DEFAULTS["stall"]

    def __post_init__(self) -> None:
        check_options(iterations=self.iterations, positive={"mu": self.mu}, beta=self.beta)

    def train(self, network: ConventionalNetwork, x: ArrayLike, y: ArrayLike) -> Training:
        """Trains on inputs x (patterns, inputs) and wanted outputs y (patterns, outputs).

        Raises InputError for arrays of other shapes.
        """
        return Training.of(network, _core.levenberg_marquardt(network.core, *as_pairs(x, y), **asdict(self)))
