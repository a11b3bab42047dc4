"""Heuristic start (2.8, 2.9)."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from rwn import _core
from rwn.networks.arrays import as_pairs
from rwn.networks.conventional_network import ConventionalNetwork
from rwn.networks.initialisation.least_squares import LeastSquares
from rwn.networks.initialisation.start import LinearStart
from rwn.networks.wavelets import Wavelet


@dataclass(frozen=True, kw_only=True)
class Heuristic:
    """Every wavelet in the middle of the domain: m = (low + high) / 2, d = 0.2 (high - low) (2.8, 2.9).

    All wavelets are equal: only random weights tell them apart.
    """

    name: ClassVar[str] = "heuristic"
    linear: LinearStart = field(default_factory=LeastSquares)

    def start(
        self, wavelet: Wavelet, x: ArrayLike, y: ArrayLike, *, wavelets: int, seed: int = 0
    ) -> ConventionalNetwork:
        """A network for inputs x (patterns, inputs) and wanted outputs y (patterns, outputs).

        Raises ValueError if an input is constant.
        """
        xs, ys = as_pairs(x, y)
        rng = np.random.default_rng(seed)
        m, d = _core.heuristic(xs, wavelets)
        b, a, w = self.linear.weights(xs, ys, wavelets=wavelets, rng=rng)
        return ConventionalNetwork(wavelet=wavelet, b=b, a=a, w=w, m=m, d=d)
