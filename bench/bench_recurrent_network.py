"""Speed of the recurrent network's training step (thesis eq. 3.1-3.19, one input) with 3, 7 and 15 wavelets,
beside numba, JAX and NumPy in one run.

    python bench/bench_recurrent_network.py

As bench_structured_network.py: every variant must end at the same parameters, variants take turns, the shortest
of many short runs counts, RWN_ISA chooses lesser kernels, and --page docs/speed.md writes the page.
"""

from __future__ import annotations

import sys

import numpy as np

import rwn
from bench_structured_network import SAMPLES, Calls, T, machine, time_all
from page import Table, asked_for
from recurrent_rivals import jax_cycle, numba_cycle
from rwn import _core
from rwn.networks.arrays import Array
from rwn.networks.rates import Fixed, RateRule, Thesis
from rwn.reference import recurrent_network as reference

ASKED = {3: 60.0, 7: 95.0, 15: 190.0}  # ns a step
RATES = {"b": 1e-3, "a": 1e-3, "w": 1e-3, "m": 1e-3, "d": 1e-3, "c": 1e-3}
HELD = np.array(list(RATES.values()))
ROUNDS = 150


def network(wavelets: int) -> rwn.RecurrentNetwork:
    rng = np.random.default_rng(wavelets)
    d = np.full((wavelets, 1), 0.6)
    m = np.linspace(-1, 1, wavelets)[:, None]
    return rwn.RecurrentNetwork(
        b=0.0, a=np.array([0.1]), w=rng.normal(0, 0.1, wavelets), m=m, d=d, c=rng.uniform(-0.1, 0.1, d.shape)
    )


def core_theta(net: rwn.RecurrentNetwork, x: Array, y: Array, rule: RateRule, cycles: int) -> Array:
    theta, _ = _core.train_recurrent(
        net.core,
        x[:, None],
        y,
        rates=rule.core_for(net.groups),
        learn=[True] * len(net.groups),
        cycles=cycles,
        frozen_every=0,
    )
    return theta


def parts(net: rwn.RecurrentNetwork) -> tuple[Array, Array]:
    return np.array([net.b, net.a[0]]), np.array([net.w, net.m[:, 0], net.d[:, 0], net.c[:, 0]])


def check(net: rwn.RecurrentNetwork, x: Array, y: Array) -> None:
    """Ends the bench where a rival learns something else than the reference."""
    wanted = reference.train(net, x[:, None], y, rates=HELD, cycles=1)[0].theta
    linear, weights = parts(net)
    numba_cycle(linear, weights, HELD, x, y)
    jax_linear, jax_net, _ = jax_cycle(*parts(net), HELD, x, y)
    answers = {
        "rwn": core_theta(net, x, y, Fixed(RATES), 1),
        "numba": np.concatenate([linear, weights.ravel()]),
        "jax": np.concatenate([jax_linear, np.ravel(jax_net)]),
    }
    for name, theta in answers.items():
        off = float(np.linalg.norm(theta - wanted) / np.linalg.norm(wanted - net.theta))
        if not off < 1e-9:
            sys.exit(f"{name} gives another answer than the reference: {off:.1e} of what it learned")


def times(wavelets: int, x: Array, y: Array) -> dict[str, float]:
    net = network(wavelets)
    check(net, x, y)
    start = parts(net)

    def in_numba(cycles: int) -> None:
        linear, weights = start[0].copy(), start[1].copy()
        for _ in range(cycles):
            numba_cycle(linear, weights, HELD, x, y)

    def in_jax(cycles: int) -> None:
        linear, weights = start
        for _ in range(cycles):
            linear, weights, squares = jax_cycle(linear, weights, HELD, x, y)
        squares.block_until_ready()

    calls: Calls = {
        "rates held": (lambda n: core_theta(net, x, y, Fixed(RATES), n), 1),
        "thesis rule": (lambda n: core_theta(net, x, y, Thesis(fraction=1e-3), n), 1),
        "numba": (in_numba, 1),
        "JAX": (in_jax, 1),
    }
    slow: Calls = {"NumPy": (lambda n: reference.train(net, x[:, None], y, rates=HELD, cycles=n), 1)}
    return time_all(calls, ROUNDS) | time_all(slow, 3)


def main() -> None:
    bench = asked_for("recurrent", __doc__)
    t = np.arange(SAMPLES) * T
    x = np.sin(2 * np.pi * 5 * t)
    y = np.tanh(3 * x)
    found = {wavelets: times(wavelets, x, y) for wavelets in ASKED}
    rows = [
        (name, *(f"{ns[name]:.1f}, {ns[name] / ns['rates held']:.2f} x" for ns in found.values()))
        for name in found[max(found)]
    ]
    asked = ("asked at most", *(f"{most:.0f}" for most in ASKED.values()))
    title = "Recurrent network, one input: forward, V1-V3, update; ns a step, in units of held rates (answers agree):"
    bench.show(Table(title, ("", *(f"{count} wavelets" for count in ASKED)), [*rows, asked]), f"{machine()}.")


if __name__ == "__main__":
    main()
