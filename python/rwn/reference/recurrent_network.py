"""Reference for the recurrent network: eq. 3.1-3.19 as written."""

from __future__ import annotations

import numpy as np

from rwn.networks.arrays import Array
from rwn.networks.recurrent_network import RecurrentNetwork
from rwn.reference.wavelets import WAVELETS


class RecurrentRun:
    """State of a run: phi and V1-V3 (wavelets, inputs), 0 before the first sample."""

    def __init__(self, network: RecurrentNetwork) -> None:
        self.network = network
        self.phi, self.V1, self.V2, self.V3 = np.zeros((4, network.wavelets, network.inputs))

    def advance(self, x: Array) -> tuple[float, Array]:
        """Output (3.1) for the inputs x (inputs,) and its derivative by theta (3.7-3.18)."""
        net = self.network
        z = (x + net.c * self.phi - net.m) / net.d
        phi, slope, _ = WAVELETS[net.wavelet.name](z, net.wavelet.omega0)
        self.V1 = slope / net.d * (net.c * self.V1 - 1)  # 3.16
        self.V2 = slope / net.d * (-z + net.c * self.V2)  # 3.17
        self.V3 = slope / net.d * (self.phi + net.c * self.V3)  # 3.18
        self.phi = phi
        product = phi.prod(axis=1)
        others = np.array([np.delete(phi, i, axis=1).prod(axis=1) for i in range(net.inputs)]).T
        factor = net.w[:, None] * others
        parts = [factor * V for V in (self.V1, self.V2, self.V3)]  # 3.13-3.15
        gradient = np.concatenate([[1.0], x, product, *(p.ravel() for p in parts)])
        return net.b + float(net.w @ product) + float(net.a @ x), gradient

    def correct(self, rates: Array, error: float, gradient: Array) -> None:
        """theta += mu e dy/dtheta with one rate per group b, a, w, m, d, c (3.19)."""
        net = self.network
        sizes = [1, net.inputs, net.wavelets, *[net.wavelets * net.inputs] * 3]
        self.network = net.with_theta(net.theta + np.repeat(rates, sizes) * error * gradient)


def train(
    network: RecurrentNetwork, x: Array, y: Array, *, rates: Array, cycles: int
) -> tuple[RecurrentNetwork, Array]:
    """Per-sample training with held rates; the network and the errors met (cycles, n)."""
    errors = np.empty((cycles, len(y)))
    for cycle in range(cycles):
        run = RecurrentRun(network)
        for n in range(len(y)):
            output, gradient = run.advance(x[n])
            errors[cycle, n] = y[n] - output
            run.correct(rates, errors[cycle, n], gradient)
        network = run.network
    return network, errors
