"""Start of the weights by least squares (2.7)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from rwn import _core
from rwn.networks.arrays import Array
from rwn.networks.initialisation.start import Weights


@dataclass(frozen=True, kw_only=True)
class LeastSquares:
    """b and a by least squares on [1, x] (2.7); w uniform in [-scale, scale], which breaks the symmetry of
    wavelets that start equal: with least-squares w they would stay equal for ever."""

    name: ClassVar[str] = "least-squares"
    scale: float = 0.1

    def weights(self, x: Array, y: Array, *, wavelets: int, rng: np.random.Generator) -> Weights:
        """From inputs x (patterns, inputs) and wanted outputs y (patterns, outputs)."""
        linear = _core.least_squares(x, y)
        w = rng.uniform(-self.scale, self.scale, (y.shape[1], wavelets))
        return Weights(linear[0], linear[1:].T, w)
