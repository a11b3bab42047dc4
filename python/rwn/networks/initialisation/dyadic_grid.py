"""Dyadic-grid start (2.10, 2.11)."""

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
class DyadicGrid:
    """Wavelets at the nodes of a dyadic grid divided at the data's centre of gravity (2.10, 2.11), d = half
    the interval.

    All inputs of a wavelet sit at the same node; nodes of a last, incomplete scale are drawn at random.
    """

    name: ClassVar[str] = "dyadic-grid"
    linear: LinearStart = field(default_factory=LeastSquares)

    def start(
        self, wavelet: Wavelet, x: ArrayLike, y: ArrayLike, *, wavelets: int, seed: int = 0
    ) -> ConventionalNetwork:
        """A network for inputs x (patterns, inputs) and wanted outputs y (patterns, outputs).

        Raises ValueError if an input is constant.
        """
        xs, ys = as_pairs(x, y)
        rng = np.random.default_rng(seed)
        nodes, taken = _core.finest_scale(wavelets)
        m, d = _core.dyadic_grid(xs, wavelets, rng.permutation(nodes)[:taken].tolist())
        b, a, w = self.linear.weights(xs, ys, wavelets=wavelets, rng=rng)
        return ConventionalNetwork(wavelet=wavelet, b=b, a=a, w=w, m=m, d=d)
