"""The recurrent network of chapter 3 for the friction of a real machine (EMPS), beside a static one (ours).

EMPS (Janot, Gautier, Brunot 2019) is a carriage of about 95 kg whose friction torque is not measured: the force of
the motor is, and position. The model is F = M a + f(v), with f from least squares (Coulomb and viscous), from a
static sum of wavelets, and from the recurrent network, whose wavelets feed back their own outputs. The networks
start from the same wavelets over the speeds of DATA_EMPS and the same weights, and are trained together with M by
Gauss-Newton with damping on every fifth sample of it; DATA_EMPS_PULSES is not fitted. Speed and acceleration are
central differences of the position, smoothed over 41 samples as the force is.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import scipy.io

import rwn
from rwn.errors import InputError
from rwn.networks.arrays import Array
from rwn.studies.thesis.noisy import smoothed

FORCE = 35.15065  # N/V, of the benchmark
WAVELETS, WIDTH, EVERY = 15, 41, 5


@dataclass(frozen=True, eq=False, kw_only=True)
class Recording:
    """Speed (n,) [m/s], acceleration (n,) [m/s^2] and force (n,) [N], smoothed alike."""

    speed: Array
    acceleration: Array
    force: Array


def recording(path: Path) -> Recording:
    """From a file of the benchmark. Raises InputError where it is not there."""
    if not path.is_file():
        raise InputError(
            "no such recording",
            where=str(path),
            expected="the folder of EMPS, with DATA_EMPS.mat and DATA_EMPS_PULSES.mat",
            fix="name the folder that holds them",
        )
    content = scipy.io.loadmat(str(path), squeeze_me=True)
    step = float(np.mean(np.diff(content["t"])))
    speed = np.gradient(smoothed(np.asarray(content["qm"], dtype=np.float64), WIDTH), step)
    force = smoothed(FORCE * np.asarray(content["vir"], dtype=np.float64), WIDTH)
    inner = slice(WIDTH, -WIDTH)  # the ends of a moving average are its padding
    return Recording(
        speed=speed[inner], acceleration=np.gradient(speed, step)[inner], force=force[inner]
    )


def start(train: Recording) -> rwn.RecurrentNetwork:
    """b, a and w by least squares over wavelets that cover the speeds, half of them at low speed; c = 0."""
    top = float(np.abs(train.speed).max())
    wide, narrow = WAVELETS // 2, WAVELETS - WAVELETS // 2
    m = np.concatenate([np.linspace(-top, top, wide), np.linspace(-top / 10, top / 10, narrow)])
    d = np.concatenate([np.full(wide, top / 3), np.full(narrow, top / 30)])
    z = (train.speed[:, None] - m) / d
    columns = np.column_stack([train.acceleration, np.ones_like(train.speed), train.speed, -z * np.exp(-(z**2) / 2)])
    ridge = 1e-3 * np.linalg.norm(columns, axis=0).max() * np.eye(columns.shape[1])
    found = np.linalg.lstsq(
        np.vstack([columns, ridge]), np.concatenate([train.force, np.zeros(len(ridge))]), rcond=None
    )[0]
    return rwn.RecurrentNetwork(
        b=float(found[1]), a=found[2:3], w=found[3:], m=m[:, None], d=d[:, None], c=0 * m[:, None]
    )


def predicted(network: rwn.RecurrentNetwork, mass: float, data: Recording) -> Array:
    """Force [N]."""
    return mass * data.acceleration + network.simulate(data.speed)


def relative(force: Array, data: Recording) -> float:
    """Error of the force in percent of its size."""
    return 100 * float(np.linalg.norm(data.force - force) / np.linalg.norm(data.force))


def trained(
    network: rwn.RecurrentNetwork, mass: float, data: Recording, *, feedback: bool, iterations: int
) -> tuple[rwn.RecurrentNetwork, float]:
    """Damped Gauss-Newton on the mass and b, a, w, m, d, and with `feedback` c."""
    count = len(network.theta) - (0 if feedback else network.wavelets)
    damping = 1e-3
    residual = data.force - predicted(network, mass, data)
    for _ in range(iterations):
        jacobian = np.column_stack([data.acceleration, network.sensitivities(data.speed)[1][:, :count]])[::EVERY]
        normal = jacobian.T @ jacobian
        step = np.linalg.solve(
            normal + damping * np.diag(np.diag(normal) + 1e-12 * np.trace(normal)), jacobian.T @ residual[::EVERY]
        )
        theta = network.theta.copy()
        theta[:count] += step[1:]
        try:
            moved = network.with_theta(theta)
            left = data.force - predicted(moved, mass + step[0], data)
        except ValueError:  # a dilation came to zero
            damping *= 4
            continue
        if np.linalg.norm(left) < np.linalg.norm(residual):
            network, mass, residual, damping = moved, mass + float(step[0]), left, damping / 3
        else:
            damping *= 4
    return network, mass


def compare(folder: Path, iterations: int = 100) -> dict[str, tuple[float, float]]:
    """Relative error of the force [%] by model, on DATA_EMPS (fitted) and on DATA_EMPS_PULSES."""
    train, test = (recording(folder / name) for name in ("DATA_EMPS.mat", "DATA_EMPS_PULSES.mat"))

    def columns(data: Recording) -> Array:
        return np.column_stack([data.acceleration, np.sign(data.speed), data.speed, np.ones_like(data.speed)])

    plain = np.linalg.lstsq(columns(train), train.force, rcond=None)[0]
    errors = tuple(relative(columns(data) @ plain, data) for data in (train, test))
    found = {"Coulomb, viscous, offset": (errors[0], errors[1])}
    begun = start(train)
    for name, feedback in (("static sum of wavelets", False), ("recurrent network", True)):
        network, mass = trained(begun, float(plain[0]), train, feedback=feedback, iterations=iterations)
        found[name] = (
            relative(predicted(network, mass, train), train),
            relative(predicted(network, mass, test), test),
        )
    return found
