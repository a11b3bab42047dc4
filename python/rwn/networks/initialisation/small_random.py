"""Start of the weights by small random numbers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from rwn.networks.arrays import Array
from rwn.networks.initialisation.start import Weights


@dataclass(frozen=True, kw_only=True)
class SmallRandom:
    """b, a and w uniform in [-scale, scale]."""

    name: ClassVar[str] = "small-random"
    scale: float = 0.1

    def weights(self, x: Array, y: Array, *, wavelets: int, rng: np.random.Generator) -> Weights:
        """From inputs x (patterns, inputs) and wanted outputs y (patterns, outputs)."""
        outputs, inputs = y.shape[1], x.shape[1]
        b, a, w = (rng.uniform(-self.scale, self.scale, (outputs, n)) for n in (1, inputs, wavelets))
        return Weights(b[:, 0], a, w)
