"""The motor's equations in plain Python for scipy's adaptive integrator: a slow judge of the plant.

Dry friction only for motion in one direction: sticking is judged by closed forms in cpp/tests/plant/plant_test.cpp.
"""
# ruff: noqa: ARG005  (hooks all have the same arguments, most use few)

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

LOAD_VISCOUS_SHARE = 0.3  # of the viscous friction that is behind a shaft or gap, where a test does not say

Array = NDArray[np.float64]


def zero(*_: float) -> float:
    return 0.0


def one(*_: float) -> float:
    return 1.0


@dataclass(frozen=True)
class Machine:
    """Hooks of (time, current, speed, angle); `extra` states have rates of their own and may act back."""

    braking: Callable[..., float] = zero  # N m
    drop: Callable[..., float] = zero  # V
    flux: Callable[..., float] = one  # factor of Kt, Ke
    magnet: Callable[..., float] = one  # another, of (time, current, speed, angle, *extra)
    inductance: Callable[..., float] = one  # factor of L
    warmth: Callable[..., float] = one  # factor of R, of (time, current, speed, angle, *extra)
    inertia: Callable[[float], tuple[float, float]] = lambda _: (0.0, 0.0)  # added J(theta) and its slope
    driver: Callable[[float], float] = lambda v: v
    delay: float = 0.0
    extra: Callable[..., tuple[float, ...]] = lambda *_: ()  # rates of the extra states
    extras: int = 0
    coupling: Callable[..., float] = zero  # braking torque that depends on the extra states
    motor_inertia: float | None = None


def two_masses(
    motor: dict[str, float], load: float, stiffness: float, damping: float, gap: float = 0.0, *,
    share: float = LOAD_VISCOUS_SHARE,
) -> Machine:  # fmt: skip
    """A shaft to a load, which bears its `share` of the viscous friction; extra states: its speed and angle."""
    drag = share * motor["viscous_friction"]

    def torque(w: float, th: float, wl: float, thl: float) -> float:
        twist = th - thl
        bend = twist - min(max(twist, -gap / 2), gap / 2)
        push = stiffness * bend + damping * (w - wl)
        return 0.0 if gap > 0.0 and push * bend <= 0.0 else push

    return Machine(
        motor_inertia=motor["inertia"] - load,
        extras=2,
        extra=lambda t, i, w, th, wl, thl: ((torque(w, th, wl, thl) - drag * wl) / load, wl),
        coupling=lambda t, i, w, th, wl, thl: torque(w, th, wl, thl) - drag * w,
    )


def run(motor: dict[str, float], machine: Machine, voltage: Array, rate: float) -> Array:
    """Rows of (current, speed, angle, extra states...), before each voltage acts."""
    R, L, Kt = motor["resistance"], motor["inductance"], motor["torque_constant"]
    J = motor["inertia"] if machine.motor_inertia is None else machine.motor_inertia

    def slope(t: float, x: Array, v: float) -> list[float]:
        i, w, th, *rest = x
        flux = machine.flux(t, i, w, th) * machine.magnet(t, i, w, th, *rest)
        resistance = R * machine.warmth(t, i, w, th, *rest)
        di = (v - resistance * i - Kt * flux * w - machine.drop(t, i, w, th)) / (
            L * machine.inductance(t, i, w, th)
        )
        added, bend = machine.inertia(th)
        brake = (
            motor["viscous_friction"] * w
            + machine.braking(t, i, w, th)
            + machine.coupling(t, i, w, th, *rest)
        )
        dw = (Kt * flux * i - brake - 0.5 * bend * w * w) / (J + added)
        return [di, dw, w, *machine.extra(t, i, w, th, *rest)]

    x = np.zeros(3 + machine.extras)
    rows = np.empty((voltage.size, x.size))
    whole, part = divmod(machine.delay * rate, 1.0)
    for k in range(voltage.size):
        rows[k] = x
        for begin, end, row in ((0.0, part, k - int(whole) - 1), (part, 1.0, k - int(whole))):
            if end - begin > 1e-9:
                v = machine.driver(voltage[row]) if row >= 0 else 0.0
                span = ((k + begin) / rate, (k + end) / rate)
                x = solve_ivp(slope, span, x, args=(v,), method="RK45", rtol=1e-9, atol=1e-11).y[:, -1]
    return rows
