"""Random conventional networks, in the core and in the reference, for tests."""

from __future__ import annotations

import numpy as np
from hypothesis import strategies as st

from rwn import ConventionalNetwork, Wavelet
from rwn.networks.arrays import Array
from rwn.networks.wavelets import WAVELETS
from rwn.reference.conventional_network import ConventionalNetwork as Plain

wavelets = st.builds(Wavelet, st.sampled_from(WAVELETS), st.sampled_from([1.75, 5.0]))


def random_network(
    wavelet: Wavelet, *, inputs: int, wavelets: int, outputs: int, seed: int
) -> tuple[ConventionalNetwork, Plain, np.random.Generator]:
    """A network, its reference, and the generator to draw data from."""
    rng = np.random.default_rng(seed)
    parts: dict[str, Array] = {
        "b": rng.normal(size=outputs),
        "a": rng.normal(size=(outputs, inputs)),
        "w": rng.normal(size=(outputs, wavelets)),
        "m": rng.uniform(-1, 1, (wavelets, inputs)),
        "d": rng.uniform(0.5, 1.5, (wavelets, inputs)) * rng.choice([-1, 1], (wavelets, inputs)),
    }
    return ConventionalNetwork(wavelet=wavelet, **parts), Plain(wavelet.name, wavelet.omega0, **parts), rng


def relative(got: Array, want: Array) -> float:
    """Largest difference over the largest wanted value."""
    return float(np.max(np.abs(got - want)) / np.max(np.abs(want)))
