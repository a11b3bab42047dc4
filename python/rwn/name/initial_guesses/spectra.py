"""First guesses of spatial frequencies: spectra of what is left over the angle.

A speed residual r answers an unknown torque T as the linear drive does (`rwn.simulate.linear_response`). Regressors are
passed through that filter, so the residual is never differentiated.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rwn.fit.fit import Fit
from rwn.fit.problem import Problem
from rwn.model.vocabulary import Effect, motor_values
from rwn.name.initial_guesses.guess import Guess
from rwn.recording.speed_measurement import integral
from rwn.simulate.inverse_dynamics import needed_force
from rwn.simulate.linear_response import speed_filter
from rwn.simulate.run import Run
from rwn.simulate.unknown_inputs import unknown_inputs

Array = NDArray[np.float64]

NEIGHBOURS = 1.5  # steps of the grid within which an order may be the leakage of a stronger one
SEEN_PERIODS = 2.0  # what came once need not come back
PER_TURN = 4  # places of a revolution at which a torque of fewer than one period is added up
FARTHEST = 2e5  # revolutions, whose spectrum takes some 20 MB: what a position in a wrong unit travels has no end
LEVEL = 0.01  # chance that the highest line of a spectrum of noise is beyond `highest_by_chance`


def read(problem: Problem, base: Fit, effect: Effect, count: int) -> list[Guess] | None:
    """Spatial frequencies that explain most of what `base` leaves; none where no angle is known."""
    (order,) = (p for p in effect.parameters if p.order)
    found = slow_orders if effect.slow else orders_left
    return [{order.name: n} for n in found(problem, base, effect, count)]


def orders_left(problem: Problem, base: Fit, effect: Effect, count: int, *, apart: float = NEIGHBOURS) -> list[float]:
    """The orders that explain most of what `base` leaves, `apart` of each other at least, in steps of the grid."""
    if not any(r.angle.size for r in problem.runs):
        return []
    (order,) = (p for p in effect.parameters if p.order)
    problem = along_the_shaft(problem, base.vector, base.active)
    grid = order_grid(problem)
    grid = grid[grid >= order.lower]  # once per revolution is an unbalance
    found: list[float] = []
    by_speed, flux = any(r.speed.size for r in problem.runs), effect.site == "flux"
    if flux and all(r.current.size for r in problem.runs):
        found = orders_of(flux_spectrum(problem, base.vector, grid), grid, count, apart=apart)
        wanted: tuple[tuple[bool, int], ...] = ((True, 1),)  # with the current or without, and how many orders
    else:
        # a current that was not recorded is known badly: with it and without
        wanted = ((True, count), (False, count)) if flux else ((False, count),)
        if not (flux and by_speed):
            found = orders_of(torque_spectrum(problem, base.vector, base.active, grid), grid, count, apart=apart)
    if not by_speed:
        return found
    residuals = problem.residuals(base.vector, base.active)
    for with_current, most in wanted:
        spectrum = angle_spectrum(problem, base.vector, residuals, grid, with_current=with_current)
        found += orders_of(spectrum, grid, most, apart=apart)
    return list(dict.fromkeys(found))


def slow_orders(problem: Problem, base: Fit, effect: Effect, count: int) -> list[float]:
    """The orders below one period per revolution at which a torque explains most of what `base` leaves.

    Those of which two periods are seen at least, for what came once need not come back, and that stand out of the
    spectrum more than noise does. The torque is added up by the angle, four times a revolution, so that this is as fine
    as a long travel allows.
    """
    (order,) = (p for p in effect.parameters if p.order)
    problem = along_the_shaft(problem, base.vector, base.active)
    turns = [problem.simulator.angle_per_position * r.angle / (2.0 * np.pi) for r in problem.runs]
    travel = min(max((float(np.ptp(t)) for t in turns if t.size), default=0.0), FARTHEST)
    bins = 2 * (int(PER_TURN * travel) + 1)  # zeros behind it halve the steps of the grid
    orders: Array = np.fft.rfftfreq(bins, 1.0 / PER_TURN).astype(np.float64)
    power = np.zeros(orders.size)
    for run, turned in zip(problem.runs, turns, strict=True):
        if turned.size:
            lacking = _lacking_torque(problem, base.vector, base.active, run)
            near = turned - turned.min() <= travel
            place = (PER_TURN * (turned - turned.min())[near]).astype(np.intp)
            by_place = np.bincount(place, (lacking - lacking.mean())[near], minlength=bins)
            power += np.abs(np.fft.rfft(by_place, n=bins)) ** 2
    seen = (orders * travel >= SEEN_PERIODS) & (orders >= order.lower) & (orders <= order.upper)
    return standing_out(power[seen], orders[seen], count)


def along_the_shaft(problem: Problem, vector: Array, active: Sequence[int]) -> Problem:
    """`problem` with the angles that effects act along, at a parameter vector (all,).

    They are without what a simulated sensor adds to the speed.
    """
    runs = []
    for run in problem.runs:
        if run.follows and run.angle_from_speed and run.speed.size:
            shown = problem.simulate(run, vector, active).signals
            by_speed = integral(run.speed_measured, run.time, shown["speed"])
            angle = run.angle - (by_speed - (shown["position"] - shown["position"][0]))
            run = replace(run, angle=angle, angle_from_speed=False)
        runs.append(run)
    return replace(problem, runs=tuple(runs))


def angle_spectrum(
    problem: Problem,
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

    energy, phases = 1e-300, _phases(problem.runs)
    grams, loads = (np.zeros((max(phases) + 1, orders.size, *size)) for size in ((2, 2), (2,)))
    for run, phase, residual in zip(problem.runs, phases, residuals, strict=True):
        if "speed" not in residual or not run.angle.size:
            continue
        angle = problem.simulator.angle_per_position * run.angle
        r = residual["speed"]
        drive = current_of(problem, motor, run) if with_current else 1.0
        r = r - r.mean()
        a, b = speed_filter(problem.drive, motor, run.sample_time)
        for k, wave in enumerate(_waves(angle, orders)):
            answer = lfilter([0.0, b], [1.0, -a], drive * wave)
            answer -= answer.mean()
            grams[phase, k] += _gram(answer)
            load = complex(answer @ r)
            loads[phase, k] += load.real, load.imag
        energy += float(r @ r)
    explained: Array = np.sum(list(map(_explained, grams, loads)), axis=0)
    return explained / energy


def _phases(runs: Sequence[Run]) -> list[int]:
    """Which runs share a phase, a number each: those whose angle is known; every other has one of its own."""
    return [k + 1 if run.angle_unknown else 0 for k, run in enumerate(runs)]


def flux_spectrum(problem: Problem, motor: Array, orders: Array) -> Array:
    """Share of the winding's voltage error that a back-EMF w cos(N theta), w sin(N theta) explains, per order N.

    `motor`: (all,), `orders` and result: (k,).

    The voltage that R, L and Ke leave along the recorded current and speed holds a ripple of Ke at once, whatever the
    free run has lost; what another R, L and Ke could take is taken out first. Of recordings that have a current.
    """
    parts = []
    for run, number in zip(problem.runs, _phases(problem.runs), strict=True):
        inputs = unknown_inputs(problem.drive, problem.simulator, run, motor)
        linear = np.stack([inputs.current, np.gradient(inputs.current, run.time), inputs.speed], axis=1)
        parts.append((inputs.voltage, linear, inputs.speed, inputs.angle, np.full(run.time.size, number)))
    voltage, linear, speed, angle, phase = (np.concatenate(rows) for rows in zip(*parts, strict=True))
    basis, _ = np.linalg.qr(linear)
    left = _beside(basis, voltage)
    explained = np.zeros(orders.size)
    for number in np.unique(phase):
        grams, loads = np.zeros((orders.size, 2, 2)), np.zeros((orders.size, 2))
        of_phase = np.where(phase == number, speed, 0.0)[:, None]
        for k, wave in enumerate(_waves(angle, orders)):
            ripple = _beside(basis, np.stack([wave.real, wave.imag], axis=1) * of_phase)
            grams[k], loads[k] = ripple.T @ ripple, ripple.T @ left
        explained += _explained(grams, loads)
    return explained / max(float(left @ left), 1e-300)


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


def torque_spectrum(problem: Problem, vector: Array, active: Sequence[int], orders: Array) -> Array:
    """As `angle_spectrum` (k,), of the torque lacking along the recorded motion, whatever the free run has lost.

    It is a derivative, whose noise may hide a small torque that the speed shows.
    """
    grams, loads, energy = np.zeros((orders.size, 2, 2)), np.zeros((orders.size, 2)), 1e-300
    for run in problem.runs:
        lacking = _lacking_torque(problem, vector, active, run)
        lacking = lacking - lacking.mean()
        angle = problem.simulator.angle_per_position * run.angle
        for k, wave in enumerate(_waves(angle, orders)):
            grams[k] += _gram(wave)
            load = complex(wave @ lacking)
            loads[k] += load.real, load.imag
        energy += float(lacking @ lacking)
    return _explained(grams, loads) / energy


def _lacking_torque(problem: Problem, vector: Array, active: Sequence[int], run: Run) -> Array:
    if not problem.drive.force:
        return unknown_inputs(problem.drive, problem.simulator, run, vector).torque
    speed, acceleration = run.motion
    needed = needed_force(
        problem.simulator, vector, active, time=run.time, position=np.ascontiguousarray(run.angle), speed=speed,
        acceleration=acceleration,
    )  # fmt: skip
    lacking: Array = needed - run.input
    return lacking


def current_of(problem: Problem, motor: Array, run: Run) -> Array:
    """What drives (n,): the force [N or N m] of an axis, else the current [A], recorded or by voltage and speed."""
    if not problem.drive.winding:
        return run.input
    if run.current.size:
        return run.current
    return problem.drive.resting_current(motor_values(motor), run.speed, run.input)


def orders_of(spectrum: Array, orders: Array, count: int, *, apart: float = NEIGHBOURS) -> list[float]:
    """Of `orders` (k,) those that explain most, `apart` of each other at least, in steps of the grid."""
    found: list[float] = []
    for k in np.argsort(spectrum)[::-1]:
        if all(abs(orders[k] - o) > apart * (orders[1] - orders[0]) for o in found):
            found.append(float(orders[k]))
        if len(found) == count:
            break
    return found


def standing_out(spectrum: Array, orders: Array, count: int) -> list[float]:
    """Of `orders`, (k,) evenly spaced, those that explain most and more than noise does at any of them."""
    if orders.size == 0:
        return []
    level = highest_by_chance(spectrum)
    return [n for n in orders_of(spectrum, orders, count) if spectrum[np.searchsorted(orders, n)] > level]


def highest_by_chance(spectrum: Array) -> float:
    """What the highest line of noise (k,) with this median exceeds with a chance of LEVEL, as lines are exponential."""
    return float(np.median(spectrum) / np.log(2.0) * np.log(spectrum.size / LEVEL))


def order_grid(problem: Problem) -> Array:
    """Orders (k,) worth looking at: whole numbers per revolution; as fine as the travel allows on a linear axis."""
    if not problem.drive.linear:
        return np.arange(1.0, 121.0)
    travel = max(float(np.ptp(r.angle)) for r in problem.runs if r.angle.size)
    return np.arange(2.0, 900.0) * (0.5 / max(travel, 1e-9))
