"""Recordings of a made-up motor with one more torque, and short definitions of own effects."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

import rwn
from rwn.model.model import Model
from rwn.model.own_effects import OwnEffect, OwnParameter

Array = NDArray[np.float64]
Torque = Callable[[float, float], float]  # of speed and angle
MOTOR = {"resistance": 0.8, "inductance": 1.5e-3, "torque_constant": 0.1, "back_emf_constant": 0.1, "inertia": 3e-4,
         "viscous_friction": 7e-5}  # fmt: skip
SMALL = {"resistance": 1.0, "inductance": 1e-3, "torque_constant": 0.05, "back_emf_constant": 0.05, "inertia": 2e-5,
         "viscous_friction": 2e-5}  # fmt: skip


def own(term: str, equation: str, **units: str) -> OwnEffect:
    parameters = (OwnParameter(name=k, unit=u, lower=-1e6, upper=1e6, start=1, strength=True) for k, u in units.items())
    return OwnEffect(name="mine", term=term, equation=equation, parameters=tuple(parameters))


def plant(voltage: Array, torque: Torque, *, step: float = 1e-3, parts: int = 6) -> Array:
    """Current, speed and position (n, 3) of the motor with one more torque: plain Runge-Kutta."""
    r, inductance, kt, ke, inertia, b = MOTOR.values()

    def slope(i: float, w: float, angle: float, v: float) -> tuple[float, float, float]:
        return (v - r * i - ke * w) / inductance, (kt * i - b * w + torque(w, angle)) / inertia, w

    i = w = angle = 0.0
    rows, h = [], step / parts
    for v in voltage.tolist():  # plain numbers: arrays of three take several times as long
        rows.append((i, w, angle))
        for _ in range(parts):
            a1, b1, c1 = slope(i, w, angle, v)
            a2, b2, c2 = slope(i + h / 2 * a1, w + h / 2 * b1, angle + h / 2 * c1, v)
            a3, b3, c3 = slope(i + h / 2 * a2, w + h / 2 * b2, angle + h / 2 * c2, v)
            a4, b4, c4 = slope(i + h * a3, w + h * b3, angle + h * c3, v)
            i += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
            w += h / 6 * (b1 + 2 * b2 + 2 * b3 + b4)
            angle += h / 6 * (c1 + 2 * c2 + 2 * c3 + c4)
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


def eddies(speed: float, _: float = 0.0) -> float:
    """Torque of the brake of `BRAKE` with a peak of 30 mN m at 40 rad/s."""
    return -2 * 0.03 * (speed / 40) / (1 + (speed / 40) ** 2)


BRAKE = OwnEffect(
    name="eddy-brake",
    term="torque",
    equation="-2 * peak * (speed / corner) / (1 + (speed / corner)^2)",
    meaning="eddy currents in a disc: torque falls again at high speed",
    parameters=(
        OwnParameter(name="peak", unit="N m", lower=0, upper=0.5, start=0.01, strength=True, meaning="most torque"),
        OwnParameter(name="corner", unit="rad/s", lower=1, upper=500, start=100, meaning="speed of most torque"),
    ),
)
BRAKED_NOMINAL = Model(
    kind="dc",
    parameters={**MOTOR, "inertia": 3.2e-4, "resistance": 0.78},
    uncertainty={"resistance": 0.05, "inertia": 0.1, "viscous_friction": 0.3, "torque_constant": 0.03},
    own_effects=(BRAKE,),
)


AXIS = Model(
    kind="axis", parameters={"inertia": 1.4e-3, "viscous_friction": 1.7e-3, "coulomb_friction": 0.1},
    uncertainty={"inertia": 0.05, "viscous_friction": 0.2, "coulomb_friction": 0.1},
)  # fmt: skip


def slow_axis(*, cogging: float, periods: float) -> rwn.Recording:
    """6 s of an axis that 0.16 N m do not move out of its detent and -0.08 N m do, which then turns to and fro."""
    time, rng = 1e-3 * np.arange(6000), np.random.default_rng(4)
    torque = 0.2 * np.sin(2.0 * np.pi * 0.25 * time) + 0.03 * np.sin(2.0 * np.pi * 1.3 * time)
    torque[:400], torque[400:800] = 0.16, -0.08
    effects = {"cogging-torque": {"amplitude": cogging, "periods_per_rev": periods, "phase": 0.9}}
    run = rwn.Recording(name="axis", time=time, signals={"torque": torque})
    seen = rwn.simulate(replace(AXIS, effects=effects), run).signals
    noise = {"speed": 0.1, "position": 1e-4}
    return replace(
        run, signals={"torque": torque} | {s: seen[s] + rng.normal(0.0, n, time.size) for s, n in noise.items()}
    )
