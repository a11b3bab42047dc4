"""Reference for the recursive Gauss-Newton trainer: the extended Kalman filter with full covariance."""

from __future__ import annotations

import numpy as np

from rwn.networks.arrays import Array
from rwn.networks.structured_network import StructuredNetwork
from rwn.reference.structured_network import StructuredRun


def train(
    network: StructuredNetwork, u: Array, y: Array, *, spread: Array, noise: float, forgetting: float
) -> tuple[StructuredNetwork, Array]:
    """Network and deviations: K = C phi / (lambda r + phi C phi), C = (C - K phi C)/lambda."""
    run, covariance = StructuredRun(network, np.zeros(2)), np.diag(spread**2)
    for n in range(1, len(y)):
        error = y[n] - run.advance(u[n - 1], y[n - 1])
        phi = run.R[0]
        gain = covariance @ phi / (forgetting * noise**2 + phi @ covariance @ phi)
        run.shift(gain * error)
        covariance = (covariance - np.outer(gain, phi @ covariance)) / forgetting
        covariance = (covariance + covariance.T) / 2
    return network.with_theta(run.theta), np.sqrt(np.diag(covariance))
