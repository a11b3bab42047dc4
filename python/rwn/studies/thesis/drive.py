"""The motor of Appendix C (200 W), its friction and its test signals, as chapters 3 to 5 use them.

Open in the thesis, and chosen here: the friction's levels (Tc = no-load current x Kt = 0.044 N m, Ts =
0.06, alpha = 5, B = 0.06, beta = 10 as stated); the plant is the Euler-forward difference equation at T
= 0.1 ms, the network's own discretisation, so that the true parameters give an error of zero; a cycle is
1 s, 10 000 samples.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache

import numpy as np
from numpy.typing import ArrayLike

import rwn
from rwn.networks.arrays import Array

T = 1e-4
SAMPLES = 10_000
MOTOR = rwn.MotorParameters(
    resistance=0.4, inductance=0.8e-3, torque_constant=0.055, inertia=1.8e-4, viscous_friction=0.06
)


@dataclass(frozen=True, kw_only=True)
class Friction:
    """Friction of (3.99) without its viscous part; `coulomb` and `static` are its levels Tc and Ts [N m]."""

    coulomb: float = 0.044
    static: float = 0.06

    def torque(self, speed: ArrayLike) -> Array:
        """Torque [N m] at a speed [rad/s]."""
        w = np.asarray(speed, dtype=np.float64)
        level = self.coulomb + (self.static - self.coulomb) * np.exp(-5 * w**2)
        return np.asarray(np.tanh(10 * w) * level, dtype=np.float64)


FRICTION = Friction()


def sine(amplitude: float, frequency: float, samples: int = SAMPLES) -> Array:
    """Sine voltage [V]."""
    return np.asarray(amplitude * np.sin(2 * np.pi * frequency * T * np.arange(samples)), dtype=np.float64)


def chirp(amplitude: float, low: float, high: float, samples: int = SAMPLES) -> Array:
    """Chirp voltage [V], linear from `low` to `high` [Hz] over the cycle."""
    t = T * np.arange(samples)
    return amplitude * np.sin(2 * np.pi * (low * t + (high - low) * t**2 / (2 * T * samples)))


@cache
def _speed(voltage: bytes, viscous: float, friction: Friction) -> Array:
    u, (speed, current) = np.frombuffer(voltage), (0.0, 0.0)
    out = np.empty(len(u))
    m = MOTOR
    for n, volts in enumerate(u):
        out[n] = speed
        level = friction.coulomb + (friction.static - friction.coulomb) * np.exp(-5 * speed * speed)
        torque = m.torque_constant * current - viscous * speed - np.tanh(10 * speed) * level
        current += T / m.inductance * (volts - m.resistance * current - m.torque_constant * speed)
        speed += T / m.inertia * torque
    return out


def speed_with_friction(
    voltage: Array, viscous: float = MOTOR.viscous_friction, friction: Friction = FRICTION
) -> Array:
    """Speed (n,) [rad/s] of the motor with the friction of (3.99)."""
    return _speed(np.ascontiguousarray(voltage, dtype=np.float64).tobytes(), viscous, friction)


def linear_network(**changes: float) -> rwn.StructuredNetwork:
    """The structured network without friction, with some motor parameters changed."""
    return rwn.StructuredNetwork.from_motor(replace(MOTOR, **changes), sample_time=T)


def dyadic_shapes(low: float, high: float, count: int) -> tuple[Array, Array]:
    """Translations and dilations (2.10-2.11), intervals halved at their centres, the last level from the
    left."""
    grid: list[tuple[float, float]] = []
    level = [(low, high)]
    while len(grid) < count:
        grid += [((a + b) / 2, 0.5 * (b - a)) for a, b in level]
        level = [half for a, b in level for half in ((a, (a + b) / 2), ((a + b) / 2, b))]
    m, d = np.array(grid[:count]).T
    return m, d


def friction_network(
    speed: Array,
    wavelets: int,
    *,
    seed: int,
    wavelet: rwn.Wavelet | None = None,
    motor: rwn.MotorParameters = MOTOR,
    size: float = 0.1,
) -> rwn.StructuredNetwork:
    """Dyadic wavelets over the speeds of a recording, w uniform in [-size, size], c = 0."""
    m, d = dyadic_shapes(float(speed.min()), float(speed.max()), wavelets)
    w = np.random.default_rng(seed).uniform(-size, size, wavelets)
    return rwn.StructuredNetwork.from_motor(
        motor, sample_time=T, w=w, m=m, d=d, c=0 * m, wavelet=wavelet or rwn.Wavelet()
    )


def error_percent(network: rwn.StructuredNetwork, name: str) -> float:
    """Error of a motor parameter in percent of its true value."""
    true = float(getattr(MOTOR, name))
    return 100 * (float(getattr(network.motor(T), name)) / true - 1)
