"""Speed of the structured network's training step, N_w = 15, beside NumPy, numba and JAX in one run.

    python bench/bench_structured_network.py

Every variant trains the same network on the same recording and must end at the same parameters.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from time import perf_counter

import numpy as np

import rwn
from rwn import _core
from rwn.rates import Fixed, Thesis
from rwn.reference import structured_network as twin
from structured_rivals import jax_cycle, numba_cycle

SAMPLES, WAVELETS, SEEDS, REPEATS = 10_000, 15, 8, 200
T = 1e-4
LEARN = ("v1", "v2", "v3", "w", "m", "d", "c")
RATES = {"v1": 1e-5, "v2": 1e-5, "v3": 1e-6, "w": 1e-5, "m": 1e-3, "d": 1e-3, "c": 1e-3}
# By hand, per wavelet: z 4, phi and phi' 26 (exp 20), V1-V3 10, T 2, P and Q 28, sum 2, update 8, a division;
# linear part: A 7, x 9, P and Q 33, update 10, error 3. A multiply-add counts as two.
PER_WAVELET, LINEAR = 80 + 1, 62
VECTOR_OPS = 62  # multiply-adds, products and sums per vector of wavelets, spread over two ports
CHAIN = (
    ("theta", 4),
    ("1/d", 13),
    ("z", 8),
    ("exp", 44),
    ("phi, w phi", 8),
    ("sum over lanes", 15),
    ("x1", 8),
    ("e, mu e", 7),
)


def motor() -> rwn.MotorParameters:
    return rwn.MotorParameters(
        resistance=0.4, inductance=0.8e-3, torque_constant=0.055, inertia=1.8e-4, viscous_friction=0.06
    )


def recording() -> tuple[np.ndarray, np.ndarray]:
    u = np.sin(2 * np.pi * np.arange(SAMPLES) * T)
    linear = rwn.StructuredNetwork.from_motor(replace(motor(), viscous_friction=0.1), sample_time=T)
    return u, linear.simulate(u, 0 * u)


def network(seed: int, span: float) -> rwn.StructuredNetwork:
    rng = np.random.default_rng(seed)
    d = np.full(WAVELETS, 0.3 * span)
    return rwn.StructuredNetwork.from_motor(
        motor(),
        sample_time=T,
        w=rng.normal(0, 0.01, WAVELETS),
        m=np.linspace(-span, span, WAVELETS),
        d=d,
        c=rng.uniform(-0.1, 0.1, WAVELETS) * d,
    )


def best(call: Callable[[], object], repeats: int) -> float:
    """Shortest time of `call` [ns per sample]."""
    times = []
    for _ in range(repeats):
        begin = perf_counter()
        call()
        times.append(perf_counter() - begin)
    return min(times) / SAMPLES * 1e9


def clock_ghz() -> float:
    """Clock rate now, from a loop of two dependent integer operations in numba (1 cycle each)."""
    import numba

    @numba.njit
    def spin(n: int, step: int) -> int:
        state = 1
        for _ in range(n):
            state = (state ^ step) + step
        return state

    spin(10, 3)
    n, times = 1_000_000, []
    for _ in range(50):
        begin = perf_counter()
        spin(n, 3)
        times.append(perf_counter() - begin)
    return 2 * n / min(times) / 1e9


def core_cycle(net: rwn.StructuredNetwork, u: np.ndarray, y: np.ndarray, rule: Fixed | Thesis) -> np.ndarray:
    mask = [group in LEARN for group in net.groups]
    theta, _ = _core.train_structured(
        net.core,
        u,
        y,
        np.zeros(2),
        rates=rule.core_for(net.groups),
        learn=mask,
        cycles=1,
        frozen_every=0,
        follow_state=False,
    )
    return theta


def per_cycle(make: Callable[[int], object]) -> float:
    """ns per sample, from runs of 1 and of 5 cycles (their difference leaves out what is done once)."""
    one, many = (best(lambda n=n: make(n), REPEATS) for n in (1, 5))  # type: ignore[misc]
    return (many - one) / 4


def main() -> None:
    u, y = recording()
    span = float(np.abs(y).max())
    net = network(0, span)
    rates = np.array([RATES.get(g, 0.0) for g in net.groups])
    start, rule = np.zeros(2), Fixed(RATES)
    mask = [group in LEARN for group in net.groups]

    def core(cycles: int, rule: Fixed | Thesis) -> np.ndarray:
        theta, _ = _core.train_structured(
            net.core,
            u,
            y,
            start,
            rates=rule.core_for(net.groups),
            learn=mask,
            cycles=cycles,
            frozen_every=0,
            follow_state=False,
        )
        return theta

    wanted, _ = twin.train(net, u, y, rates=rates, cycles=1)
    answers = {"rwn": core(1, rule)}
    v, weights = net.v.copy(), np.array([net.w, net.m, net.d, net.c])
    numba_cycle(v, weights, rates, u, y)
    answers["numba"] = np.concatenate([v, weights.ravel()])
    jv, jn, _ = jax_cycle(net.v, np.array([net.w, net.m, net.d, net.c]), rates, u, y)
    answers["jax"] = np.concatenate([jv, np.ravel(jn)])
    for name, theta in answers.items():
        moved = np.linalg.norm(wanted.theta - net.theta)
        off = float(np.linalg.norm(theta - wanted.theta) / moved)
        print(f"{name:6s} agrees with the NumPy twin to {off:.1e} of what it learned in {SAMPLES} samples")
        if not off < 1e-9:
            sys.exit(f"{name} gives another answer than the reference")

    networks = [network(seed, span) for seed in range(SEEDS)]
    theta, many = np.array([n.theta for n in networks]), np.tile(rates, (SEEDS, 1))
    together, *_ = _core.train_side_by_side(theta, net.wavelet.core, many, u, y, start, cycles=1)
    for k, one in enumerate(networks):
        alone = core_cycle(one, u, y, rule)
        if not np.allclose(together[k], alone, rtol=1e-11):
            sys.exit("runs side by side differ from runs alone")

    held = per_cycle(lambda n: core(n, rule))
    thesis = per_cycle(lambda n: core(n, Thesis(fraction=1e-4, printed=True)))
    side = (
        per_cycle(lambda n: _core.train_side_by_side(theta, net.wavelet.core, many, u, y, start, cycles=n))
        / SEEDS
    )
    in_numba = best(
        lambda: numba_cycle(net.v.copy(), np.array([net.w, net.m, net.d, net.c]), rates, u, y), REPEATS
    )
    arguments = (net.v, np.array([net.w, net.m, net.d, net.c]), rates, u, y)
    in_jax = best(lambda: jax_cycle(*arguments)[2].block_until_ready(), REPEATS)
    in_numpy = best(lambda: twin.train(net, u, y, rates=rates, cycles=1), 2)
    report(held, thesis, side, in_numba, in_jax, in_numpy)


def report(held: float, thesis: float, side: float, in_numba: float, in_jax: float, in_numpy: float) -> None:
    width = {"baseline": 2, "avx2": 4, "avx512": 8}[_core.isa()]
    ghz = clock_ghz()
    vectors = -(-WAVELETS // width)
    flops = WAVELETS * PER_WAVELET + LINEAR
    throughput = (vectors * VECTOR_OPS / 2 + LINEAR / 4) / ghz
    latency = sum(cycles for _, cycles in CHAIN) / ghz
    cpu = next(s for s in Path("/proc/cpuinfo").read_text().splitlines() if s.startswith("model name"))
    compiler = subprocess.run(
        ["g++", "--version"], capture_output=True, text=True, check=False
    ).stdout.splitlines()[0]
    print(f"\n{cpu.split(':')[1].strip()}, {ghz:.2f} GHz now, {_core.isa()}; {compiler}")
    print(
        f"N_w = {WAVELETS}: forward, V1-V3, P and Q of v1..v3 and 4 x {WAVELETS}, update; rates held\n"
    )
    rows = [
        ("rwn, rates held", held, "", ""),
        ("rwn, thesis rule at every sample", thesis, f"{thesis / held:.2f} x held", "at most 2"),
        (
            f"rwn, {SEEDS} seeds side by side, per seed",
            side,
            f"{held / side:.2f} x throughput",
            "at least 1.8",
        ),
        ("numba (fastmath)", in_numba, f"{in_numba / held:.1f} x", "at least 3"),
        ("JAX (jit, lax.scan, float64)", in_jax, f"{in_jax / held:.1f} x", "at least 15"),
        ("NumPy twin", in_numpy, f"{in_numpy / held:.0f} x", "at least 450"),
    ]
    for name, time, ratio, target in rows:
        print(f"{name:42s} {time:10.1f} ns/sample   {ratio:20s} {target}")
    print(
        f"\nhand count: {flops} operations per sample, {flops / held:.1f} per ns with held rates"
    )
    print(
        f"throughput bound (2 multiply-add ports): {throughput:.1f} ns; {held / throughput:.2f} x alone, ",
        end="",
    )
    print(f"{side / throughput:.2f} side by side")
    print(
        f"latency bound: {' + '.join(f'{name} {cycles}' for name, cycles in CHAIN)} cycles = {latency:.1f} ns"
    )


if __name__ == "__main__":
    main()
