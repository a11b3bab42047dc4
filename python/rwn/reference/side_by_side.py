"""Networks trained side by side, in NumPy: one after another."""

from __future__ import annotations

from collections.abc import Sequence

from rwn.networks.arrays import Array
from rwn.networks.structured_network import StructuredNetwork
from rwn.reference import structured_network


def train(
    networks: Sequence[StructuredNetwork], u: Array, y: Array, *, rates: Array, cycles: int
) -> list[StructuredNetwork]:
    """Per-sample training with held rates (N, 9)."""
    return [
        structured_network.train(network, u, y, rates=mu, cycles=cycles)[0]
        for network, mu in zip(networks, rates, strict=True)
    ]
