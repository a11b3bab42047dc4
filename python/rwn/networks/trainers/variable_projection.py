"""Variable projection: Levenberg-Marquardt on translations and dilations, least squares for the rest."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import ClassVar

from numpy.typing import ArrayLike

from rwn import _core
from rwn.networks.arrays import as_pairs
from rwn.networks.conventional_network import ConventionalNetwork
from rwn.networks.training import Training, check_options

_DEFAULTS = _core.trainer_defaults()["variable-projection"]


@dataclass(frozen=True, kw_only=True)
class VariableProjection:
    """b, a and w are the least-squares solution at every step (Golub & Pereyra 1973, Jacobian of Kaufman
    1975).

    mu: first damping, relative to the diagonal of J^T J.
    beta: factor of the damping, above 1.
    resolution: dilations stay above this many mean distances of the patterns and below 4 ranges of the input;
        a narrower wavelet fits one pattern and says nothing between them, a wider one is a straight line.
        0 lets them go.
    iterations: most Jacobians.
    target: MSE at which to stop.
    stall: relative change of the MSE over 100 iterations below which to stop; -1 never stops.
    """

    name: ClassVar[str] = "variable-projection"
    mu: float = _DEFAULTS["mu"]
    beta: float = _DEFAULTS["beta"]
    resolution: float = _DEFAULTS["resolution"]
    iterations: int = _DEFAULTS["iterations"]
    target: float = _DEFAULTS["target"]
    stall: float = _DEFAULTS["stall"]

    def __post_init__(self) -> None:
        check_options(iterations=self.iterations, positive={"mu": self.mu}, beta=self.beta)

    def train(self, network: ConventionalNetwork, x: ArrayLike, y: ArrayLike) -> Training:
        """Trains on inputs x (patterns, inputs) and wanted outputs y (patterns, outputs).

        Raises InputError for arrays of other shapes.
        """
        return Training.of(network, _core.variable_projection(network.core, *as_pairs(x, y), **asdict(self)))
