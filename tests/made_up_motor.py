"""Recordings of a made-up motor with one more torque, and short definitions of own effects."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

import rwn
from rwn.model.own_effects import OwnEffect, OwnParameter

Array = NDArray[np.float64]
Torque = Callable[[float, float], float]  # of speed and angle
MOTOR = {"resistance": 0.8, "inductance": 1.5e-3, "torque_constant": 0.1, "back_emf_constant": 0.1, "inertia": 3e-4,
         "viscous_friction": 7e-5}  # fmt: skip


def own(term: str, equation: str, **units: str) -> OwnEffect:
    parameters = (OwnParameter(name=k, unit=u, lower=-1e6, upper=1e6, start=1, strength=True) for k, u in units.items())
    return OwnEffect(name="mine", term=term, equation=equation, parameters=tuple(parameters))


def plant(voltage: Array, torque: Torque, *, step: float = 1e-3, parts: int = 6) -> Array:
    """Current, speed and position (n, 3) of the motor with one more torque: plain Runge-Kutta."""
    r, inductance, kt, ke, inertia, b = MOTOR.values()

    def slope(x: Array, v: float) -> Array:
        i, w, angle = x
        return np.array([(v - r * i - ke * w) / inductance, (kt * i - b * w + torque(w, angle)) / inertia, w])

    x, rows, h = np.zeros(3), [], step / parts
    for v in voltage:
        rows.append(x)
        for _ in range(parts):
            k1 = slope(x, v)
            k2 = slope(x + h / 2 * k1, v)
            k3 = slope(x + h / 2 * k2, v)
            k4 = slope(x + h * k3, v)
            x = x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    return np.array(rows)


def shaking(rng: np.random.Generator, t: Array) -> Array:
    """A voltage of three tones, in steps of 10 mV."""
    tones = zip((9.0, 6.0, 3.0), rng.uniform(0.4, 3.0, 3), rng.uniform(0.0, 6.0, 3), strict=True)
    return np.asarray(np.round(sum(a * np.sin(2 * np.pi * f * t + p) for a, f, p in tones), 2))


def recorded(seed: int, torque: Torque, samples: int = 2000) -> rwn.Recording:
    rng = np.random.default_rng(seed)
    t = 1e-3 * np.arange(samples)
    voltage = shaking(rng, t)
    rows = plant(voltage, torque)
    signals = {
        "voltage": voltage,
        "current": rows[:, 0] + rng.normal(0, 0.02, samples),
        "speed": rows[:, 1] + rng.normal(0, 0.2, samples),
    }
    return rwn.Recording(name=f"run_{seed}.csv", time=t, signals=signals)
