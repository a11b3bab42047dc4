"""Reference for the trainers of static networks: parameters after the given number of iterations, and the MSE
history."""

from __future__ import annotations

import numpy as np

from rwn.networks.arrays import Array
from rwn.reference.conventional_network import ConventionalNetwork

Run = tuple[ConventionalNetwork, list[float]]


def _mse(network: ConventionalNetwork, x: Array, y: Array) -> float:
    return float(np.mean((y - network.output(x)) ** 2))


def gradient_descent(
    network: ConventionalNetwork, x: Array, y: Array, *, rate: float, momentum: float, iterations: int
) -> Run:
    """(2.20) on the mean over patterns."""
    step = np.zeros_like(network.parameters)
    history = [_mse(network, x, y)]
    for _ in range(iterations):
        step = -rate * network.gradient(x, y) / len(x) + momentum * step
        network = network.with_parameters(network.parameters + step)
        history.append(_mse(network, x, y))
    return network, history


def pattern_descent(
    network: ConventionalNetwork,
    x: Array,
    y: Array,
    *,
    rate: float,
    momentum: float,
    shape_momentum: float,
    iterations: int,
) -> Run:
    """(2.20) after every pattern; the history is the mean square of the errors met."""
    factor = np.full_like(network.parameters, momentum)
    factor[-2 * network.m.size :] = shape_momentum
    step = np.zeros_like(factor)
    history = []
    for _ in range(iterations):
        squares = 0.0
        for p in range(len(x)):
            xp, yp = x[p : p + 1], y[p : p + 1]
            squares += float(np.sum((yp - network.output(xp)) ** 2))
            step = -rate * network.gradient(xp, yp) + factor * step
            network = network.with_parameters(network.parameters + step)
        history.append(squares / y.size)
    return network, history


def pattern_gauss_newton(
    network: ConventionalNetwork, x: Array, y: Array, *, prior: Array, noise: float, forgetting: float
) -> ConventionalNetwork:
    """One pass of recursive least squares on the linearised network, covariance form; prior: deviations."""
    covariance = np.diag(prior**2)
    for p in range(len(x)):
        for k in range(y.shape[1]):
            row = network.jacobian(x[p : p + 1])[0, k]
            error = y[p, k] - network.output(x[p : p + 1])[0, k]
            gain = covariance @ row / (forgetting * noise**2 + row @ covariance @ row)
            covariance = (covariance - np.outer(gain, row @ covariance)) / forgetting
            network = network.with_parameters(network.parameters + gain * error)
    return network


def levenberg_marquardt(
    network: ConventionalNetwork, x: Array, y: Array, *, mu: float, beta: float, iterations: int
) -> Run:
    """(2.22-2.24), one Jacobian per iteration."""
    history = [_mse(network, x, y)]
    for _ in range(iterations):
        error = (y - network.output(x)).ravel()
        jacobian = network.jacobian(x).reshape(error.size, -1)
        theta = network.parameters
        while True:
            damped = jacobian.T @ jacobian + mu * np.eye(theta.size)
            network = network.with_parameters(theta + np.linalg.solve(damped, jacobian.T @ error))
            if _mse(network, x, y) < history[-1]:
                break
            mu *= beta
        mu /= beta
        history.append(_mse(network, x, y))
    return network, history


def project(network: ConventionalNetwork, x: Array, y: Array) -> ConventionalNetwork:
    """The network with b, a and w at their least-squares solution for its wavelets: variable projection's
    inner step."""
    _, phi, _ = network.layer(x)
    linear = np.linalg.lstsq(np.column_stack([np.ones(len(x)), x, phi]), y, rcond=None)[0]
    inputs = x.shape[1]
    flat = np.concatenate([linear[0], linear[1 : 1 + inputs].T.ravel(), linear[1 + inputs :].T.ravel()])
    return network.with_parameters(np.concatenate([flat, network.parameters[flat.size :]]))
