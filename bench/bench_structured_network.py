"""Speed of the structured network's training step, N_w = 15, beside NumPy, numba and JAX in one run.

    python bench/bench_structured_network.py

Every variant trains the same network on the same recording and must end at the same parameters. RWN_ISA
(baseline, avx2, avx512) chooses lesser kernels than the processor's best. The variants take turns and the
shortest of many short runs counts, so that a busy machine costs repeats, not truth. --page docs/speed.md writes
the page.
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
from page import Bench, Table, asked_for
from rwn import _core
from rwn.networks.arrays import Array
from rwn.networks.rates import Fixed, Thesis
from rwn.reference import structured_network as reference
from structured_rivals import jax_cycle, numba_cycle

SAMPLES, WAVELETS, SEEDS, ROUNDS, MORE = 2_000, 15, 8, 400, 8
T = 1e-4
LEARN = ("v1", "v2", "v3", "w", "m", "d", "c")
RATES = {"v1": 1e-5, "v2": 1e-5, "v3": 1e-6, "w": 1e-5, "m": 1e-3, "d": 1e-3, "c": 1e-3}
# By hand, per wavelet: z 4, phi and phi' 26 (exp 20), V1-V3 10, T 2, P and Q 28, sum 2, update 8, a division;
# linear part: A 7, x 9, P and Q 33, update 10, error 3. A multiply-add counts as two.
PER_WAVELET, LINEAR = 80 + 1, 62
# The same as instructions where multiply-adds are one: z 3, 1/d, exp 19, phi and phi' 4, V1-V3 6, T 1, P and Q 20,
# sum 1, update 4 per vector of wavelets; all but the difference in z and the rounding in exp need a multiplier.
MULTIPLIES, LINEAR_MULTIPLIES = 57, 37  # linear: A 3, P and Q 17, x 6, error 1, update 10
PORTS = 2  # that multiply, per cycle
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


def recording() -> tuple[Array, Array]:
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


Calls = dict[str, tuple[Callable[[int], object], int]]  # what to do for a number of cycles; networks at once


def time_all(calls: Calls, rounds: int) -> dict[str, float]:
    """ns per sample and network: shortest of long runs less shortest of one cycle, which leaves out what is
    done once. A long run trains 8 cycles more in all, so that a busy machine disturbs each variant alike."""
    lengths = {name: (1, 1 + MORE // networks) for name, (_, networks) in calls.items()}
    shortest = {(name, cycles): np.inf for name, both in lengths.items() for cycles in both}
    for _ in range(rounds):
        for (name, cycles), met in shortest.items():
            begin = perf_counter()
            calls[name][0](cycles)
            shortest[name, cycles] = min(met, perf_counter() - begin)
    return {
        name: (shortest[name, long] - shortest[name, one]) / MORE / SAMPLES * 1e9
        for name, (one, long) in lengths.items()
    }


def clock_ghz() -> float:
    """Clock rate now, from a loop of two dependent integer operations in numba (1 cycle each)."""
    import numba

    @numba.njit  # type: ignore[untyped-decorator]
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


def core_theta(net: rwn.StructuredNetwork, u: Array, y: Array, rule: Fixed | Thesis, cycles: int) -> Array:
    theta, _ = _core.train_structured(
        net.core,
        u,
        y,
        np.zeros(2),
        rates=rule.core_for(net.groups),
        learn=[group in LEARN for group in net.groups],
        cycles=cycles,
        frozen_every=0,
        follow_state=False,
    )
    return theta


def parts(net: rwn.StructuredNetwork) -> tuple[Array, Array]:
    return net.v.copy(), np.array([net.w, net.m, net.d, net.c])


def check(net: rwn.StructuredNetwork, u: Array, y: Array, rates: Array) -> None:
    """Ends the bench where a rival learns something else than the reference."""
    wanted, _ = reference.train(net, u, y, rates=rates, cycles=1)
    answers = {"rwn": core_theta(net, u, y, Fixed(RATES), 1)}
    v, weights = parts(net)
    numba_cycle(v, weights, rates, u, y)
    answers["numba"] = np.concatenate([v, weights.ravel()])
    jv, jn, _ = jax_cycle(*parts(net), rates, u, y)
    answers["jax"] = np.concatenate([jv, np.ravel(jn)])
    for name, theta in answers.items():
        moved = np.linalg.norm(wanted.theta - net.theta)
        off = float(np.linalg.norm(theta - wanted.theta) / moved)
        print(f"{name:6s} agrees with the NumPy reference to {off:.1e} of what it learned in {SAMPLES} samples")
        if not off < 1e-9:
            sys.exit(f"{name} gives another answer than the reference")


def check_side_by_side(networks: list[rwn.StructuredNetwork], u: Array, y: Array) -> None:
    together = rwn.train_side_by_side(networks, u, y, rates=Fixed(RATES))
    for one, alone in zip(together.networks, networks, strict=True):
        if not np.allclose(one.theta, core_theta(alone, u, y, Fixed(RATES), 1), rtol=1e-11):
            sys.exit("runs side by side differ from runs alone")


def main() -> None:
    bench = asked_for("structured", __doc__)
    u, y = recording()
    span = float(np.abs(y).max())
    networks = [network(seed, span) for seed in range(SEEDS)]
    net, theta = networks[0], np.array([one.theta for one in networks])
    rates = np.array([RATES.get(g, 0.0) for g in net.groups])
    many, start, wavelet = np.tile(rates, (SEEDS, 1)), np.zeros(2), net.wavelet.core
    check(net, u, y, rates)
    check_side_by_side(networks, u, y)
    adaptive = {name: Thesis(fraction=1e-4, eigen=name == "eigen") for name in ("thesis", "eigen")}

    def in_numba(cycles: int) -> None:
        v, weights = parts(net)
        for _ in range(cycles):
            numba_cycle(v, weights, rates, u, y)

    def in_jax(cycles: int) -> None:
        v, weights = parts(net)
        for _ in range(cycles):
            v, weights, squares = jax_cycle(v, weights, rates, u, y)
        squares.block_until_ready()

    calls: Calls = {
        "held": (lambda n: core_theta(net, u, y, Fixed(RATES), n), 1),
        "thesis": (lambda n: core_theta(net, u, y, adaptive["thesis"], n), 1),
        "side": (lambda n: _core.train_side_by_side(theta, wavelet, many, u, y, start, cycles=n), SEEDS),
        "numba": (in_numba, 1),
        "jax": (in_jax, 1),
    }
    times = time_all(calls, ROUNDS)
    times |= time_all({"eigen": (lambda n: core_theta(net, u, y, adaptive["eigen"], n), 1)}, 20)
    times |= time_all({"numpy": (lambda n: reference.train(net, u, y, rates=rates, cycles=n), 1)}, 5)
    report(times, bench)


def bounds(width: int, ghz: float) -> tuple[float, float]:
    """Least ns per sample that the multipliers need: of a run alone, of one among `width` side by side."""
    alone = -(-WAVELETS // width) * MULTIPLIES + LINEAR_MULTIPLIES
    side = (WAVELETS * MULTIPLIES + LINEAR_MULTIPLIES) / width
    return alone / PORTS / ghz, side / PORTS / ghz


def machine() -> str:
    """Processor, clock, instruction set and compiler, in one line."""
    cpu = next(s for s in Path("/proc/cpuinfo").read_text().splitlines() if s.startswith("model name"))
    compiler = subprocess.run(["g++", "--version"], capture_output=True, text=True, check=False)
    return f"{cpu.split(':')[1].strip()}, {clock_ghz():.2f} GHz now, {_core.isa()}; {compiler.stdout.splitlines()[0]}"


def report(ns: dict[str, float], bench: Bench) -> None:
    isa, ghz = _core.isa(), clock_ghz()
    alone, side = bounds({"baseline": 2, "avx2": 4, "avx512": 8}[isa], ghz)
    held = ns["held"]
    rows = [
        ("rwn, rates held", held, "", ""),
        ("rwn, thesis rule at every sample", ns["thesis"], f"{ns['thesis'] / held:.2f} x held", "at most 2"),
        ("the same, eigen=True", ns["eigen"], f"{ns['eigen'] / held:.1f} x held", ""),
        (
            f"rwn, {SEEDS} seeds side by side, per seed",
            ns["side"],
            f"{held / ns['side']:.2f} x throughput",
            f"at least 1.8; bound {held / side:.2f}",
        ),
        ("numba (fastmath)", ns["numba"], f"{ns['numba'] / held:.1f} x", "at least 3"),
        ("JAX (jit, lax.scan, float64)", ns["jax"], f"{ns['jax'] / held:.1f} x", "at least 15"),
        ("NumPy reference", ns["numpy"], f"{ns['numpy'] / held:.0f} x", "at least 450"),
    ]
    flops = WAVELETS * PER_WAVELET + LINEAR
    chain = " + ".join(f"{name} {cycles}" for name, cycles in CHAIN)
    title = f"Structured network, {WAVELETS} wavelets, one step: forward, V1-V3, P and Q, update (answers agree):"
    bench.show(
        Table(title, ("", "ns a step", "ratio", "asked"), [(n, f"{time:.1f}", *rest) for n, time, *rest in rows]),
        f"{machine()}.",
        f"By hand: {flops} operations a step, {flops / held:.1f} per ns with held rates. The multipliers ({PORTS}) "
        f"allow {alone:.1f} ns alone and {side:.1f} ns side by side; measured {held / alone:.2f} x and "
        f"{ns['side'] / side:.2f} x of that. The longest chain of results: {chain} cycles, "
        f"{sum(cycles for _, cycles in CHAIN) / ghz:.1f} ns.",
    )


if __name__ == "__main__":
    main()
