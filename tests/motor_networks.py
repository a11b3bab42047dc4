"""Random networks and signals for the tests of the recurrent and the structured network."""

from __future__ import annotations

import numpy as np

import rwn
from rwn.networks.arrays import Array

MOTOR = rwn.MotorParameters(
    resistance=0.4, inductance=0.8e-3, torque_constant=0.055, inertia=1.8e-4, viscous_friction=0.06
)
SAMPLE_TIME = 1e-4


def friction(speed: Array | float) -> Array:
    """Tustin friction without its viscous part (3.99) [N m]."""
    return np.asarray(np.tanh(10 * speed) * (0.044 + 0.016 * np.exp(-5 * np.square(speed))))


def drive(
    samples: int, *, frequency: float = 4.0, amplitude: float = 1.0, viscous: float = 0.06
) -> tuple[Array, Array]:
    """Voltage (chirp from 0 Hz) and speed of the Appendix C motor with friction, by Euler's rule."""
    t = np.arange(samples) * SAMPLE_TIME
    u = amplitude * np.sin(np.pi * frequency * t**2 / max(t[-1], SAMPLE_TIME))
    speed, current, y = 0.0, 0.0, np.empty(samples)
    for n in range(samples):
        y[n] = speed
        torque = MOTOR.torque_constant * current - viscous * speed - float(friction(speed))
        volts = u[n] - MOTOR.resistance * current - MOTOR.torque_constant * speed
        speed += SAMPLE_TIME / MOTOR.inertia * torque
        current += SAMPLE_TIME / MOTOR.inductance * volts
    return u, y


def structured(
    wavelets: int, seed: int, *, name: str = "gaussian-derivative", omega0: float = 5.0
) -> rwn.StructuredNetwork:
    """The Appendix C motor with a random network whose |c/d| max|phi'| stays below 0.5."""
    rng = np.random.default_rng(seed)
    wavelet = rwn.Wavelet(name, omega0)
    d = rng.uniform(0.2, 1.0, wavelets)
    return rwn.StructuredNetwork.from_motor(
        MOTOR,
        sample_time=SAMPLE_TIME,
        w=rng.normal(0, 0.05, wavelets),
        m=rng.uniform(-1.5, 1.5, wavelets),
        d=d,
        c=rng.uniform(-0.5, 0.5, wavelets) * d / wavelet.max_derivative,
        wavelet=wavelet,
    )


def recurrent(
    inputs: int, wavelets: int, seed: int, *, name: str = "gaussian-derivative"
) -> rwn.RecurrentNetwork:
    """A random network whose |c/d| max|phi'| stays below 0.5."""
    rng = np.random.default_rng(seed)
    wavelet = rwn.Wavelet(name)
    d = rng.uniform(0.3, 1.5, (wavelets, inputs))
    return rwn.RecurrentNetwork(
        b=rng.normal(),
        a=rng.normal(size=inputs),
        w=rng.normal(size=wavelets),
        m=rng.uniform(-1, 1, (wavelets, inputs)),
        d=d,
        c=rng.uniform(-0.5, 0.5, (wavelets, inputs)) * d / wavelet.max_derivative,
        wavelet=wavelet,
    )


def relative_error(got: Array, wanted: Array) -> float:
    """Largest difference over the largest wanted value."""
    return float(np.max(np.abs(got - wanted)) / np.max(np.abs(wanted)))
