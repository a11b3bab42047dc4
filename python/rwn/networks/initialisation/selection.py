"""Start by selection: orthogonal least squares over a wavelet library (Oussar & Dreyfus 2000)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from rwn import _core
from rwn.networks.arrays import as_pairs
from rwn.networks.conventional_network import ConventionalNetwork
from rwn.networks.trainers.variable_projection import VariableProjection
from rwn.networks.wavelets import Wavelet


@dataclass(frozen=True, kw_only=True)
class Selection:
    """Takes one wavelet after the other out of a library, each time the one that explains most of what is
    left (Oussar & Dreyfus 2000, "Initialization by selection for wavelet network training"); b, a and w are
    then least squares.

    levels: scales of the library along every input, dilations zeta (high - low) / 2^l; all combinations over
        the inputs.
    Deterministic: the seed is not used.
    """

    name: ClassVar[str] = "selection"
    levels: int = 5
    zeta: float = 0.5

    def start(
        self, wavelet: Wavelet, x: ArrayLike, y: ArrayLike, *, wavelets: int, seed: int = 0  # noqa: ARG002
    ) -> ConventionalNetwork:
        """A network for inputs x (patterns, inputs) and wanted outputs y (patterns, outputs).

        Raises ValueError if an input is constant or the library holds too few independent wavelets for these
        data.
        """
        xs, ys = as_pairs(x, y)
        m, d = _core.wavelet_library(xs, self.levels, self.zeta)
        chosen = _core.select_wavelets(wavelet.core, m, d, xs, ys, wavelets)
        if len(chosen) < wavelets:
            raise ValueError(
                f"only {len(chosen)} of {wavelets} wavelets are independent on these {len(xs)} patterns: "
                "take fewer wavelets or more levels"
            )
        outputs, inputs = ys.shape[1], xs.shape[1]
        network = ConventionalNetwork(
            wavelet=wavelet,
            b=np.zeros(outputs),
            a=np.zeros((outputs, inputs)),
            w=np.zeros((outputs, wavelets)),
            m=m[chosen],
            d=d[chosen],
        )
        return VariableProjection(iterations=0).train(network, xs, ys).network
