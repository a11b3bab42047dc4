"""The two interfaces of initialisation: of a whole network, and of its weights b, a, w."""

from __future__ import annotations

from typing import ClassVar, NamedTuple, Protocol

import numpy as np
from numpy.typing import ArrayLike

from rwn.networks.arrays import Array
from rwn.networks.conventional_network import ConventionalNetwork
from rwn.networks.wavelets import Wavelet


class Weights(NamedTuple):
    """b (outputs,), a (outputs, inputs), w (outputs, wavelets)."""

    b: Array
    a: Array
    w: Array


class LinearStart(Protocol):
    """A way to start b, a and w."""

    name: ClassVar[str]

    def weights(self, x: Array, y: Array, *, wavelets: int, rng: np.random.Generator) -> Weights:
        """From inputs x (patterns, inputs) and wanted outputs y (patterns, outputs)."""
        ...


class Initialiser(Protocol):
    """A way to start a network for given data."""

    name: ClassVar[str]

    def start(
        self, wavelet: Wavelet, x: ArrayLike, y: ArrayLike, *, wavelets: int, seed: int = 0
    ) -> ConventionalNetwork:
        """A network for inputs x (patterns, inputs) and wanted outputs y (patterns, outputs)."""
        ...
