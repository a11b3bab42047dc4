"""Reference for the structured network: eq. 4.6-4.29 and Appendix E as written, one sample at a time."""

from __future__ import annotations

import numpy as np

from rwn.networks.arrays import Array
from rwn.networks.structured_network import StructuredNetwork
from rwn.reference.wavelets import WAVELETS


class StructuredRun:
    """State of a run: x (2,) = [speed, current], R = dx/dtheta (2, parameters), phi and V1-V3 (wavelets,)."""

    def __init__(self, network: StructuredNetwork, start: Array) -> None:
        self.v = network.v.copy()
        self.w, self.m, self.d, self.c = (a.copy() for a in (network.w, network.m, network.d, network.c))
        self.wavelet = network.wavelet
        self.phi, self.V1, self.V2, self.V3 = np.zeros((4, network.wavelets))
        self.x = np.array(start, dtype=np.float64)
        self.R = np.zeros((2, 5 + 4 * network.wavelets))
        self.torque = 0.0

    @property
    def plant(self) -> Array:
        """A of eq. 4.6."""
        v1, v2, v3, v4, v5 = self.v
        return np.array([[1 - v1 * v2, v2 * v3], [-v3 * v4, v5]])

    def friction(self, speed: float) -> Array:
        """tau(n-1) (4.10), kept, and its derivative by w, m, d, c (4 wavelets,) with V1-V3 (3.16-3.18)."""
        z = (speed + self.c * self.phi - self.m) / self.d
        phi, slope, _ = WAVELETS[self.wavelet.name](z, self.wavelet.omega0)
        slope = slope / self.d
        self.V1 = slope * (self.c * self.V1 - 1)
        self.V2 = slope * (self.c * self.V2 - z)
        self.V3 = slope * (self.c * self.V3 + self.phi)
        self.phi = phi
        self.torque = float(self.w @ phi)
        return np.concatenate([phi, self.w * self.V1, self.w * self.V2, self.w * self.V3])

    def advance(self, u: float, speed: float) -> float:
        """Speed of the next sample, from u(n-1) and the measured speed(n-1); R follows (4.13-4.28, E)."""
        v1, v2, v3, v4, _ = self.v
        A, slope = self.plant, self.friction(speed)
        x1, x2 = self.x
        drive = np.zeros_like(self.R)
        drive[0, :3] = -v2 * x1, v3 * x2 - v1 * x1 - self.torque, v2 * x2
        drive[1, 2:5] = -v4 * x1, u - v3 * x1, x2
        drive[0, 5:] = -v2 * slope
        self.R = A @ self.R + drive
        self.x = A @ self.x + np.array([-v2 * self.torque, v4 * u])
        return float(self.x[0])

    def correct(self, rates: Array, error: float, *, follow_state: bool) -> None:
        """theta += mu e P with one rate per group (4.19, 4.29); with `follow_state` x += R dtheta."""
        change = np.repeat(rates, [1] * 5 + [len(self.w)] * 4) * error * self.R[0]
        self.shift(change, follow_state=follow_state)

    def shift(self, change: Array, *, follow_state: bool = True) -> None:
        """theta += change; with `follow_state` x += R change."""
        self.v += change[:5]
        for parameter, step in zip((self.w, self.m, self.d, self.c), change[5:].reshape(4, -1), strict=True):
            parameter += step
        if follow_state:
            self.x = self.x + self.R @ change

    @property
    def theta(self) -> Array:
        """Parameters as they stand."""
        return np.concatenate([self.v, self.w, self.m, self.d, self.c])


def train(
    network: StructuredNetwork,
    u: Array,
    y: Array,
    *,
    rates: Array,
    cycles: int,
    follow_state: bool = False,
    start: tuple[float, float] = (0.0, 0.0),
) -> tuple[StructuredNetwork, Array]:
    """Per-sample training with held rates (9,); the network and the errors met (cycles, n)."""
    errors = np.empty((cycles, len(y)))
    for cycle in range(cycles):
        run = StructuredRun(network, np.array(start))
        errors[cycle, 0] = y[0] - run.x[0]
        for n in range(1, len(y)):
            errors[cycle, n] = y[n] - run.advance(u[n - 1], y[n - 1])
            run.correct(rates, errors[cycle, n], follow_state=follow_state)
        network = network.with_theta(run.theta)
    return network, errors


def sensitivities(
    network: StructuredNetwork, u: Array, y: Array, *, start: tuple[float, float] = (0.0, 0.0)
) -> tuple[Array, Array]:
    """Simulated speed (n,) and its derivative by theta (n, parameters), parameters frozen."""
    run = StructuredRun(network, np.array(start))
    speed, jacobian = np.empty(len(y)), np.zeros((len(y), run.R.shape[1]))
    speed[0] = run.x[0]
    for n in range(1, len(y)):
        speed[n] = run.advance(u[n - 1], y[n - 1])
        jacobian[n] = run.R[0]
    return speed, jacobian


def free_run(network: StructuredNetwork, slope: float, voltage: Array) -> Array:
    """Speed (n,) of the network fed with its own speed, from standstill; friction is torque(x) - slope x."""
    state, (_, v2, _, v4, _), out = np.zeros(2), network.v, np.empty(len(voltage))
    for n, volts in enumerate(voltage):
        out[n] = state[0]
        z = (state[0] - network.m) / network.d
        torque = network.w @ WAVELETS[network.wavelet.name](z, network.wavelet.omega0)[0] - slope * state[0]
        state = network.plant @ state + np.array([-v2 * torque, v4 * volts])
    return out
