"""First guesses read off a residual: spatial frequencies from a spectrum over the angle, windows from a change in time.

A speed residual r answers an unknown torque T as the linear drive does, J dr/dt + (B + Kt Ke / R) r = T. Regressors are
passed through that filter, so the residual is never differentiated.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rwn import _core
from rwn.fit.preparation import motion
from rwn.fit.problem import OutputError, Target
from rwn.locate.unknown_inputs import unknown_inputs
from rwn.model.vocabulary import motor_index
from rwn.recording.speed_measurement import integral

Array = NDArray[np.float64]


def drive_filter(problem: OutputError, motor: Array, step: float) -> tuple[float, float]:
    """(a, b) of r[k] = a r[k-1] + b T[k-1], the drive's answer to a torque held over a step."""
    inertia, damping = motor[motor_index("inertia")], motor[motor_index("viscous_friction")]
    if problem.kind == "dc":
        coupling = motor[motor_index("torque_constant")] * motor[motor_index("back_emf_constant")]
        damping += coupling / motor[motor_index("resistance")]
    rate = max(damping / inertia, 1e-9)
    a = float(np.exp(-rate * step))
    return a, (1.0 - a) / (rate * inertia)


def along_the_shaft(problem: OutputError, vector: Array, active: Sequence[int]) -> OutputError:
    """`problem` with the angles that effects act along: without what a simulated sensor adds to the speed."""
    targets = []
    for target in problem.targets:
        if target.follows and target.angle_from_speed and target.speed.size:
            run = problem.simulate(target, vector, active).signals
            shown = integral(target.speed_measured, target.time, run["speed"])
            angle = target.angle - (shown - (run["position"] - run["position"][0]))
            target = replace(target, angle=angle, angle_from_speed=False)
        targets.append(target)
    return replace(problem, targets=tuple(targets))


def angle_spectrum(
    problem: OutputError,
    motor: Array,
    residuals: Sequence[dict[str, Array]],
    orders: Array,
    *,
    with_current: bool = False,
) -> Array:
    """Share of the speed residual's energy that a torque cos(N theta), sin(N theta) explains, per order N (m,).

    `with_current`: the torque is proportional to the driving current as well (a ripple of Kt).
    """
    from scipy.signal import lfilter  # late: the command line starts without it

    energy = 1e-300
    grams, loads = np.zeros((orders.size, 2, 2)), np.zeros((orders.size, 2))
    for target, residual in zip(problem.targets, residuals, strict=True):
        if "speed" not in residual or not target.angle.size:
            continue
        angle = problem.angle_per_position * target.angle
        r = residual["speed"]
        drive = current_of(problem, motor, target) if with_current else 1.0
        r = r - r.mean()
        a, b = drive_filter(problem, motor, float(np.median(np.diff(target.time))))
        for k, wave in enumerate(_waves(angle, orders)):
            answer = lfilter([0.0, b], [1.0, -a], drive * wave)
            answer -= answer.mean()
            grams[k] += _gram(answer)
            load = complex(answer @ r)
            loads[k] += load.real, load.imag
        energy += float(r @ r)
    return _explained(grams, loads) / energy


def flux_spectrum(problem: OutputError, motor: Array, orders: Array) -> Array:
    """Share of the winding's voltage error that a back-EMF w cos(N theta), w sin(N theta) explains, per order N.

    The voltage that R, L and Ke leave along the recorded current and speed holds a ripple of Ke at once, whatever the
    free run has lost; what another R, L and Ke could take is taken out first. Of recordings that have a current.
    """
    parts = []
    for target in problem.targets:
        unknown = unknown_inputs(problem, motor, target)
        linear = np.stack([unknown.current, np.gradient(unknown.current, target.time), unknown.speed], axis=1)
        parts.append((unknown.voltage, linear, unknown.speed, unknown.angle))
    voltage, linear, speed, angle = (np.concatenate(rows) for rows in zip(*parts, strict=True))
    basis, _ = np.linalg.qr(linear)
    left = _beside(basis, voltage)
    grams, loads = np.zeros((orders.size, 2, 2)), np.zeros((orders.size, 2))
    for k, wave in enumerate(_waves(angle, orders)):
        ripple = _beside(basis, np.stack([wave.real, wave.imag], axis=1) * speed[:, None])
        grams[k], loads[k] = ripple.T @ ripple, ripple.T @ left
    return _explained(grams, loads) / max(float(left @ left), 1e-300)


def _waves(angle: Array, orders: Array) -> Iterator[NDArray[np.complex128]]:
    """exp(i N angle) of every order N; these are evenly spaced, so that each wave follows from the one before."""
    wave = np.exp(1j * orders[0] * angle)
    turn = np.exp(1j * (orders[1] - orders[0]) * angle) if orders.size > 1 else wave
    for _ in orders:
        yield wave
        wave = wave * turn


def _gram(wave: NDArray[np.complex128]) -> Array:
    """Inner products of the real and the imaginary part."""
    square, size = complex(wave @ wave), float(np.vdot(wave, wave).real)
    return 0.5 * np.array([[size + square.real, square.imag], [square.imag, size - square.real]])


def _explained(grams: Array, loads: Array) -> Array:
    """Energy that pairs of regressors of these inner products (m, 2, 2) and (m, 2) explain, (m,)."""
    ridge = 1e-9 * np.trace(grams, axis1=1, axis2=2) + 1e-300
    amplitudes = np.linalg.solve(grams + ridge[:, None, None] * np.eye(2), loads[:, :, None])[:, :, 0]
    found: Array = np.sum(loads * amplitudes, axis=1)
    return found


def _beside(basis: Array, x: Array) -> Array:
    """What columns hold beside an orthonormal basis."""
    rest: Array = x - basis @ (basis.T @ x)
    return rest


def torque_spectrum(problem: OutputError, vector: Array, active: Sequence[int], orders: Array) -> Array:
    """As `angle_spectrum`, of the torque lacking along the recorded motion: where speed is not recorded."""
    grams, loads, energy = np.zeros((orders.size, 2, 2)), np.zeros((orders.size, 2)), 1e-300
    for target in problem.targets:
        lacking = _lacking_torque(problem, vector, active, target)
        lacking = lacking - lacking.mean()
        angle = problem.angle_per_position * target.angle
        for k, wave in enumerate(_waves(angle, orders)):
            grams[k] += _gram(wave)
            load = complex(wave @ lacking)
            loads[k] += load.real, load.imag
        energy += float(lacking @ lacking)
    return _explained(grams, loads) / energy


def _lacking_torque(problem: OutputError, vector: Array, active: Sequence[int], target: Target) -> Array:
    if problem.kind != "axis":
        return unknown_inputs(problem, vector, target).torque
    speed, acceleration = motion(target)
    position = np.ascontiguousarray(target.position)
    needed = _core.inverse_dynamics(
        vector, list(active), problem.angle_per_position, target.time, position, speed, acceleration,
        problem.own,
    )
    lacking: Array = needed - target.input
    return lacking


def current_of(problem: OutputError, motor: Array, target: Target) -> Array:
    """What drives: the force of an axis, the recorded current, or what voltage and speed make of it."""
    if problem.kind != "dc":
        return target.input
    if target.current.size:
        return target.current
    emf: Array = motor[motor_index("back_emf_constant")] * target.speed
    return (target.input - emf) / float(motor[motor_index("resistance")])


def orders_of(spectrum: Array, orders: Array, count: int) -> list[float]:
    """The orders that explain most, neighbours left out."""
    found: list[float] = []
    for k in np.argsort(spectrum)[::-1]:
        if all(abs(orders[k] - o) > 1.5 * (orders[1] - orders[0]) for o in found):
            found.append(float(orders[k]))
        if len(found) == count:
            break
    return found


def order_grid(problem: OutputError) -> Array:
    """Orders worth looking at: whole numbers per revolution; as fine as the travel allows on a linear axis."""
    if problem.angle_per_position == 1.0:
        return np.arange(1.0, 121.0)
    travel = max(float(np.ptp(t.angle)) for t in problem.targets if t.angle.size)
    return np.arange(2.0, 900.0) * (0.5 / max(travel, 1e-9))


def windows(
    problem: OutputError, motor: Array, residuals: Sequence[dict[str, Array]], count: int = 2
) -> list[tuple[float, float]]:
    """(t_start, t_end) of the time windows in which a constant extra torque explains most of the residual."""
    length = max(float(t.time[-1] - t.time[0]) for t in problem.targets)
    bins = 60
    total, weight = np.zeros(bins), np.zeros(bins)
    for target, residual in zip(problem.targets, residuals, strict=True):
        if "speed" not in residual:
            continue
        r = residual["speed"]
        a, b = drive_filter(problem, motor, float(np.median(np.diff(target.time))))
        torque = (r[1:] - a * r[:-1]) / b
        place = np.minimum((bins * (target.time[:-1] - target.time[0]) / length).astype(int), bins - 1)
        total += np.bincount(place, torque, bins)
        weight += np.bincount(place, minlength=bins)
    mean = total.sum() / max(weight.sum(), 1.0)
    sums = np.concatenate([[0.0], np.cumsum(total - mean * weight)])
    counts = np.concatenate([[0.0], np.cumsum(weight)])
    i, j = np.triu_indices(bins + 1, 2)
    n, whole = counts[j] - counts[i], counts[-1]
    gain = np.where(
        (n > 0) & (n < whole),
        (sums[j] - sums[i]) ** 2 / np.maximum(n * (1.0 - n / max(whole, 1.0)), 1e-9),
        0.0,
    )
    found: list[tuple[float, float]] = []
    for k in np.argsort(gain)[::-1]:
        if all(abs(i[k] - p) + abs(j[k] - q) > bins / 6 for p, q in found):
            found.append((float(i[k]), float(j[k])))
        if len(found) == count:
            break
    # a little off the grid, so that the instants carry derivatives
    return [(length * (p + 0.013) / bins, length * (q - 0.017) / bins) for p, q in found]
