"""Reference for the learning-rate rules on the structured network, one sample at a time."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from rwn.networks.arrays import Array
from rwn.networks.rates import Normalised, Thesis, Tightened
from rwn.networks.recurrent_network import RecurrentNetwork
from rwn.networks.structured_network import StructuredNetwork
from rwn.networks.wavelets import Wavelet
from rwn.reference.recurrent_network import RecurrentRun
from rwn.reference.structured_network import StructuredRun


def plant_gain(A: Array) -> float:
    """norm(M) norm(M^-1) / (1 - rho(A)) (4.50), M the unit eigenvectors."""
    eigenvalues, M = np.linalg.eig(A)
    return float(np.linalg.cond(M) / (1 - np.abs(eigenvalues).max()))


def wavelet_bounds(wavelet: Wavelet, rule: Thesis | Tightened) -> tuple[float, float, float]:
    """max|phi|, max|phi'|, max|z phi'|: 1, 1 and unused as printed, the wavelet's own when tightened."""
    if isinstance(rule, Thesis):
        return 1.0, 1.0, 0.0
    return wavelet.max_value, wavelet.max_derivative, wavelet.max_scaled_derivative


def thesis_bounds(run: StructuredRun, maxima: dict[str, float], rule: Thesis | Tightened) -> Array:
    """Bounds of ||dy/dtheta_g|| for v1..v5, w, m, d, c (4.51-4.123, E.11, E.23)."""
    phi, slope, scaled = wavelet_bounds(run.wavelet, rule)
    v1, v2, v3, v4, _ = np.abs(run.v)
    G = plant_gain(run.plant)
    third = v3 if isinstance(rule, Thesis) and rule.misprint else v2
    linear = [
        v2 * maxima["x1"],
        v3 * maxima["x2"] + v1 * maxima["x1"] + maxima["tau"],
        third * maxima["x2"] + v4 * maxima["x1"],
        v3 * maxima["x1"] + maxima["u"],
        maxima["x2"],
    ]
    if len(run.w) == 0:
        return G * np.array([*linear, 0, 0, 0, 0])
    w, m, d, c = np.abs(run.w), np.abs(run.m), np.abs(run.d), np.abs(run.c)
    driven = w / d / (1 - slope * c / d)
    reach = (maxima["speed"] + c + m) / d if isinstance(rule, Thesis) else scaled
    translation = np.max(slope * driven)  # 3.55
    dilation = np.max(driven * reach)  # 3.73
    net = v2 * np.sqrt(len(run.w)) * np.array([phi, translation, dilation, phi * translation])
    return G * np.array([*linear, *net])


def rates_of(bounds: Array, learn: NDArray[np.bool_], rule: Thesis | Tightened) -> Array:
    """mu_g = fraction * 2 / bound_g^2 of the groups that learn (3.31, 4.30)."""
    share = learn.sum() if rule.shared else 1
    seen = learn & (bounds > 0)
    return np.where(seen, 2 * rule.fraction / share / np.where(seen, bounds, 1.0) ** 2, 0.0)


def train_thesis(
    network: StructuredNetwork, u: Array, y: Array, *, learn: Iterable[str], rule: Thesis | Tightened
) -> tuple[StructuredNetwork, Array]:
    """One cycle with the `thesis` rule, running maxima; the network and the largest bounds."""
    mask = np.array([group in set(learn) for group in network.groups])
    run = StructuredRun(network, np.zeros(2))
    maxima = dict.fromkeys(("x1", "x2", "u", "tau", "speed"), 0.0)
    largest = np.zeros(9)
    for n in range(1, len(y)):
        now = {"x1": run.x[0], "x2": run.x[1], "u": u[n - 1], "speed": y[n - 1]}
        error = y[n] - run.advance(u[n - 1], y[n - 1])
        maxima = {key: max(value, abs(now.get(key, run.torque))) for key, value in maxima.items()}
        largest = np.maximum(largest, thesis_bounds(run, maxima, rule))
        run.correct(rates_of(largest, mask, rule), error, follow_state=False)
    return network.with_theta(run.theta), largest


def recurrent_bounds(network: RecurrentNetwork, inputs: Array, rule: Thesis | Tightened) -> Array:
    """Bounds of ||dy/dtheta_g|| for b, a, w, m, d, c (3.33, 3.38, 3.44, 3.57, 3.75, 3.88); inputs: largest |x_i|."""
    phi, slope, scaled = wavelet_bounds(network.wavelet, rule)
    w, m, d, c = (np.abs(part) for part in (network.w, network.m, network.d, network.c))
    count, size = len(inputs), network.wavelets
    others = phi ** (count - 1)
    driven = others * w[:, None] / d / (1 - slope * c / d)
    reach = (inputs + c + m) / d if isinstance(rule, Thesis) else scaled
    root = np.sqrt(size * count)
    translation = root * slope * np.max(driven, initial=0.0)
    dilation = root * np.max(driven * reach, initial=0.0)
    direct = np.sqrt(count) * inputs.max()
    return np.array([1.0, direct, np.sqrt(size) * others * phi, translation, dilation, phi * translation])


def train_thesis_recurrent(
    network: RecurrentNetwork, x: Array, y: Array, *, learn: Iterable[str], rule: Thesis | Tightened
) -> tuple[RecurrentNetwork, Array]:
    """One cycle of the recurrent network with running maxima (3.19, 3.31); the network and the largest bounds."""
    mask = np.array([group in set(learn) for group in network.groups])
    run, inputs, largest = RecurrentRun(network), np.zeros(network.inputs), np.zeros(6)
    for n in range(len(y)):
        inputs = np.maximum(inputs, np.abs(x[n]))
        largest = np.maximum(largest, recurrent_bounds(run.network, inputs, rule))
        output, gradient = run.advance(x[n])
        run.correct(rates_of(largest, mask, rule), y[n] - output, gradient)
    return run.network, largest


def train_normalised(
    network: StructuredNetwork, u: Array, y: Array, *, rule: Normalised, follow_state: bool
) -> StructuredNetwork:
    """One cycle with the `normalised` rule and given scales."""
    scales = np.array([(rule.scales or {}).get(group, 0.0) for group in network.groups]) ** 2
    sizes = [1] * 5 + [network.wavelets] * 4

    def weigh(run: StructuredRun) -> float:
        return float(np.repeat(scales, sizes) @ run.R[0] ** 2)

    frozen, largest = StructuredRun(network, np.zeros(2)), 0.0
    for n in range(1, len(y)):
        frozen.advance(u[n - 1], y[n - 1])
        largest = max(largest, weigh(frozen))
    run = StructuredRun(network, np.zeros(2))
    for n in range(1, len(y)):
        error = y[n] - run.advance(u[n - 1], y[n - 1])
        step = rule.fraction / (rule.regularisation * largest + weigh(run))
        run.correct(step * scales, error, follow_state=follow_state)
    return network.with_theta(run.theta)


def impulse_response(network: StructuredNetwork, u: Array, y: Array) -> Array:
    """Rates (9,) of the `impulse-response` rule with its own fraction, shared over all groups."""
    run = StructuredRun(network, np.zeros(2))
    rho = np.abs(np.linalg.eigvals(run.plant)).max()
    row, sums = np.array([1.0, 0.0]), np.zeros(2)
    while np.linalg.norm(row) > 1e-16 * (1 - rho):
        sums += np.abs(row)
        row = row @ run.plant
    drives = []
    for n in range(1, len(y)):
        x1, x2 = run.x
        run.advance(u[n - 1], y[n - 1])
        v1, v2, v3, v4, _ = run.v
        vees = [np.linalg.norm(V) for V in (run.V1, run.V2, run.V3)]
        weighted = [v2 * np.linalg.norm(run.w * V) for V in (run.V1, run.V2, run.V3)]
        mechanical = [
            v2 * x1,
            v3 * x2 - v1 * x1 - run.torque,
            v2 * x2,
            0,
            0,
            v2 * np.linalg.norm(run.phi),
            *weighted,
        ]
        electrical = [0, 0, v4 * x1, u[n - 1] - v3 * x1, x2, 0, 0, 0, 0]
        drives.append([*mechanical, *electrical, v3 * x2, *vees])
    top = np.max(np.abs(drives), axis=0)
    mechanical, electrical, torque, vees = top[:9], top[9:18], top[18], top[19:]
    mechanical[6:] = np.maximum(mechanical[6:], run.v[1] * torque / np.sqrt(network.wavelets) * vees)
    bound = sums[0] * mechanical + sums[1] * electrical
    return np.asarray(2 * (1 - rho) / 4 / 9 / bound**2, dtype=np.float64)
