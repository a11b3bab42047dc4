"""Table 20 step by step: from a recording to the motor and its friction curve. The page shows these functions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import rwn
from rwn.networks.arrays import Array
from rwn.networks.initialisation import StructuredSelection
from rwn.networks.trainers import StructuredFit, StructuredLevenbergMarquardt
from rwn.studies.thesis.drive import MOTOR, chirp, error_percent, linear_network, sine, speed_with_friction
from rwn.studies.thesis.noisy import Noisy
from rwn.studies.thesis.noisy import noisy as with_noise
from rwn.studies.thesis.simultaneous import WRONG, total_slope, true_torque


@dataclass(frozen=True, kw_only=True)
class WalkThrough:
    """What the steps find."""

    voltage: Array
    speed: Array
    believed: rwn.StructuredNetwork
    selected: rwn.StructuredNetwork
    fit: StructuredFit
    linear: tuple[StructuredFit, StructuredFit]
    loose: StructuredFit
    noisy: tuple[Noisy, StructuredFit]
    test: tuple[Array, Array]


def record() -> tuple[Array, Array]:
    """One second of voltage [V] and speed [rad/s] of the motor: the thesis's 1 V chirp, 0 to 4 Hz."""
    voltage = chirp(1.0, 0.0, 4.0)
    return voltage, speed_with_friction(voltage)


def believe() -> rwn.StructuredNetwork:
    """What the engineer has: J 20 % too high, B 20 % too low, no other friction."""
    return linear_network(inertia=WRONG.inertia, viscous_friction=WRONG.viscous_friction)


def select(believed: rwn.StructuredNetwork, voltage: Array, speed: Array) -> rwn.StructuredNetwork:
    """Fifteen wavelets, each taken for what it explains of the recording beside J, B and those before it."""
    return StructuredSelection().start(believed, voltage, speed, wavelets=15, linear=("v1", "v2"))


def weigh(
    selected: rwn.StructuredNetwork, voltage: Array, speed: Array, *, gauge: bool
) -> StructuredFit:
    """Only B, J and the weights: what the linear part of the problem determines, with the gauge and without."""
    trainer = StructuredLevenbergMarquardt(iterations=60, gauge=gauge)
    return trainer.fit(selected, voltage, speed, learn=("v1", "v2", "w"))


def fit(selected: rwn.StructuredNetwork, voltage: Array, speed: Array) -> StructuredFit:
    """B, J, weights, translations and dilations at once, in 60 iterations."""
    trainer = StructuredLevenbergMarquardt(iterations=60)
    return trainer.fit(selected, voltage, speed, learn=("v1", "v2", "w", "m", "d"))


def fit_noisy(voltage: Array, speed: Array, decibel: float = 40.0) -> tuple[Noisy, StructuredFit]:
    """The same from a noisy speed: the network is fed with the speed that the model simulates."""
    measured, sigma = with_noise(speed, decibel, np.random.default_rng(0))
    recording = Noisy(voltage=voltage, speed=measured, noise=sigma)
    return recording, recording.fit(WRONG, ("v1", "v2"), "simulated", 60)


def fit_loose(selected: rwn.StructuredNetwork, recording: Noisy) -> StructuredFit:
    """What noise does without a gauge, the network fed with the measured speed, as in the thesis."""
    return weigh(selected, recording.voltage, recording.speed, gauge=False)


def walk() -> WalkThrough:
    """All steps."""
    voltage, speed = record()
    believed = believe()
    selected = select(believed, voltage, speed)
    noisy = fit_noisy(voltage, speed)
    other = sine(1.0, 1.0)
    return WalkThrough(
        voltage=voltage,
        speed=speed,
        believed=believed,
        selected=selected,
        fit=fit(selected, voltage, speed),
        linear=(
            weigh(selected, voltage, speed, gauge=False),
            weigh(selected, voltage, speed, gauge=True),
        ),
        loose=fit_loose(selected, noisy[0]),
        noisy=noisy,
        test=(other, speed_with_friction(other)),
    )


@dataclass(frozen=True, kw_only=True)
class Found:
    """A fit held beside the truth: errors [%], the half width of the 95 % interval of J [%], curve rms [N m]."""

    inertia: float
    interval: float
    slope: float
    raw_viscous: float
    rms: float
    condition: float


def judge(found: StructuredFit, speed: Array, along: Array) -> Found:
    """Errors of a fit; the total slope is that along the speed that the gauge was taken from."""
    true = true_torque(speed)
    return Found(
        inertia=error_percent(found.network, "inertia"),
        interval=100 * 1.96 * float(found.deviation[1] / found.network.v[1]),
        slope=100 * (total_slope(found.friction(along), along) / total_slope(true_torque(along), along) - 1),
        raw_viscous=100 * (float(found.network.v[0]) / MOTOR.viscous_friction - 1),
        rms=float(np.sqrt(np.mean((found.friction(speed) - true) ** 2))),
        condition=found.condition,
    )


def free_run_error(walked: WalkThrough) -> tuple[float, float]:
    """Root mean square speed error [rad/s] on the test signal in a free run: believed motor, and corrected."""
    voltage, speed = walked.test
    before = walked.believed.simulate(voltage, 0 * voltage)
    after = walked.fit.free_run(voltage)
    return float(np.sqrt(np.mean((before - speed) ** 2))), float(np.sqrt(np.mean((after - speed) ** 2)))
