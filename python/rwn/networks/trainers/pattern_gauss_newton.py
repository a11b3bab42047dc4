"""Recursive Gauss-Newton after every pattern, in square-root form: the online trainer to take."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import ClassVar

from numpy.typing import ArrayLike

from rwn import _core
from rwn.networks.arrays import as_pairs
from rwn.networks.conventional_network import ConventionalNetwork
from rwn.networks.training import Training, check_options

_DEFAULTS = _core.trainer_defaults()["pattern-gauss-newton"]


@dataclass(frozen=True, kw_only=True)
class PatternGaussNewton:
    """Recursive Gauss-Newton (Kalman filter of constant parameters) with Potter's square-root update.

    noise: standard deviation of the errors, in units of the outputs; beside the priors it sets how far the
        first patterns may move the parameters.
    weight_prior: standard deviation of b, a and w about their start.
    shape_prior: standard deviation of translations and dilations about their start, in dilations.
    forgetting: factor on old information per pattern, in (0, 1]; below 1, since it was gathered about other
        parameters: with 1 the first, wrong linearisations are never forgiven.
    iterations: most passes over the patterns.
    target: MSE at which to stop.
    stall: relative change of the MSE over 100 iterations below which to stop; -1 never stops.

    Raises ValueError for options outside their range.
    """

    name: ClassVar[str] = "pattern-gauss-newton"
    noise: float = _DEFAULTS["noise"]
    weight_prior: float = _DEFAULTS["weight_prior"]
    shape_prior: float = _DEFAULTS["shape_prior"]
    forgetting: float = _DEFAULTS["forgetting"]
    iterations: int = _DEFAULTS["iterations"]
    target: float = _DEFAULTS["target"]
    stall: float = _DEFAULTS["stall"]

    def __post_init__(self) -> None:
        positive = {"noise": self.noise, "weight_prior": self.weight_prior, "shape_prior": self.shape_prior}
        check_options(iterations=self.iterations, positive=positive)
        if not 0 < self.forgetting <= 1:
            raise ValueError(f"forgetting must be in (0, 1], got {self.forgetting}")

    def train(self, network: ConventionalNetwork, x: ArrayLike, y: ArrayLike) -> Training:
        """Trains on inputs x (patterns, inputs) and wanted outputs y (patterns, outputs).

        Raises InputError for arrays of other shapes.
        """
        return Training.of(network, _core.pattern_gauss_newton(network.core, *as_pairs(x, y), **asdict(self)))
