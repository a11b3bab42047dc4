"""What a test bench plays: voltages in open loop, speed references for the controller in closed loop.

Every function returns an array (samples,) with peak 1; `tau` is the mechanical time constant in samples.
A new excitation is a function and its entry in the table.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from rwn.studies.trials.plant import Array

Rng = np.random.Generator
Shape = Callable[[Rng, int, float], Array]


def _levels(rng: Rng, samples: int, hold: tuple[float, float]) -> Array:
    """Random levels in [-1, 1], each held for a random time in the range `hold` (samples)."""
    out = np.zeros(samples)
    at = 0
    while at < samples:
        until = at + max(int(rng.uniform(*hold)), 2)
        out[at:until] = rng.uniform(-1.0, 1.0)
        at = until
    return out


def _unit(x: Array) -> Array:
    return np.asarray(x / np.max(np.abs(x)), dtype=np.float64)


def steps(rng: Rng, samples: int, tau: float) -> Array:
    return _unit(_levels(rng, samples, (2.0 * tau, 9.0 * tau)))


def prbs(rng: Rng, samples: int, tau: float) -> Array:
    clock = max(int(tau * rng.uniform(0.4, 1.2)), 3)
    bits = rng.integers(0, 2, samples // clock + 1) * 2.0 - 1.0
    offset = rng.uniform(-0.5, 0.5)
    return _unit(np.repeat(bits, clock)[:samples] * (1.0 - abs(offset)) + offset)


def chirp(rng: Rng, samples: int, tau: float) -> Array:
    time = np.arange(samples, dtype=np.float64)
    slow = 1.5 / samples * rng.uniform(0.7, 2.0)
    fast = max(rng.uniform(0.3, 1.0) / tau, 2.0 * slow)
    exponent = np.log(fast / slow)
    turns = slow * samples / exponent * (np.exp(exponent * time / samples) - 1.0)
    offset = rng.choice([0.0, 0.0, rng.uniform(-0.4, 0.4)])
    sign = rng.choice([-1.0, 1.0])
    return _unit((1.0 - abs(offset)) * sign * np.sin(2.0 * np.pi * turns) + offset)


def multisine(rng: Rng, samples: int, tau: float) -> Array:
    """Odd lines up to about the motor's bandwidth, random phases, falling amplitudes."""
    time = np.arange(samples) / samples
    top = max(int(samples / (2.0 * np.pi * tau) * rng.uniform(1.0, 3.0)), 7)
    lines = np.arange(1, top, 2)
    phases = rng.uniform(-np.pi, np.pi, lines.size)
    amplitudes = 1.0 / np.sqrt(1.0 + (lines / (0.3 * top)) ** 2)
    waves = np.sin(2.0 * np.pi * np.outer(time, lines) + phases)
    return _unit(waves @ amplitudes)


def trapezoid(rng: Rng, samples: int, tau: float) -> Array:
    """Ramps to random levels and plateaus, with a sign that alternates most of the time."""
    knots, levels = [0.0], [0.0]
    sign = rng.choice([-1.0, 1.0])
    while knots[-1] < samples:
        level = sign * rng.uniform(0.3, 1.0)
        for height, length in (
            (level, rng.uniform(1.0, 6.0)),
            (level, rng.uniform(1.5, 6.0)),
            (0.0, rng.uniform(1.0, 6.0)),
            (0.0, rng.uniform(0.0, 2.0)),
        ):
            knots.append(knots[-1] + max(length * tau, 2.0))
            levels.append(height)
        sign = -sign if rng.random() < 0.8 else sign
    return _unit(np.interp(np.arange(samples, dtype=np.float64), knots, levels))


OPEN_LOOP: dict[str, Shape] = {
    "chirp": chirp,
    "steps": steps,
    "multisine": multisine,
    "prbs": prbs,
    "trapezoid": trapezoid,
}
CLOSED_LOOP: dict[str, Shape] = {"cl_steps": steps, "cl_trap": trapezoid}
KINDS: tuple[str, ...] = (*OPEN_LOOP, *CLOSED_LOOP)
