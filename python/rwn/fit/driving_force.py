"""The problem of an axis whose motion is held by a controller: the error of its driving force, not of its motion.

A stiff loop makes the motion what it was asked to be, whatever acts; what acts shows in the force that this took. A
free run from the force then says nothing of it, and short free runs are won by whatever makes the axis deaf to its
force. So the force that the equations need for the recorded motion is compared with the recorded one, as robots are
identified (Gautier 1997; Janot, Gautier, Brunot 2019), both through the same smoothing and decimation.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from rwn.fit.problem import Problem
from rwn.fit.residual_noise import noise_of
from rwn.parallel import side_by_side
from rwn.recording.noise import Noise, noise_from_differences
from rwn.recording.signals import DRIVING_FORCE
from rwn.recording.smoothing import LENGTHS, noise_gain, smooth, taken
from rwn.simulate.inverse_dynamics import needed_force
from rwn.simulate.run import Run
from rwn.simulate.simulator import NormalEquations

Array = NDArray[np.float64]

SLOPE = 1e-4  # step of the differences that derivatives are taken by, relative to a parameter's value
SMALL = 1e-9  # least value of a parameter that the step is relative to


@dataclass(frozen=True, kw_only=True)
class BalancedRun(Run):
    """The smoothed motion of a recording, one sample of each smoothing length, with the force that drove it."""

    velocity: Array = field(default_factory=lambda: np.empty(0))
    acceleration: Array = field(default_factory=lambda: np.empty(0))

    @property
    def recorded(self) -> tuple[str, ...]:
        """The driving force alone is compared."""
        return (DRIVING_FORCE,)

    def signal(self, name: str) -> Array:
        """The driving force (n,) [N m or N]; of the motion what was recorded of it, smoothed, in SI."""
        return self.input if name == DRIVING_FORCE else super().signal(name)

    def quantisation(self, signal: str) -> float:  # noqa: ARG002
        """Smoothed values are multiples of no step."""
        return 0.0

    @cached_property
    def motion(self) -> tuple[Array, Array]:
        """Speed [rad/s or m/s] and acceleration [rad/s^2 or m/s^2], (n,) each."""
        return self.velocity, self.acceleration

    def until(self, end: int) -> BalancedRun:
        """Its first `end` samples."""
        return replace(super().until(end), velocity=self.velocity[:end], acceleration=self.acceleration[:end])  # type: ignore[call-arg,return-value]

    def with_intersample(self, law: str) -> BalancedRun:  # noqa: ARG002
        """The same: a balance at each instant knows nothing of what the input was between the rows."""
        return self


def balanced(run: Run, inertia: float) -> BalancedRun:
    """A recording with a position as the balance of forces takes it, of an axis of an `inertia` [kg m^2 or kg]."""
    length, step = _length(run, inertia), run.sample_time
    rows = slice(length, run.time.size - length, length)
    measured, near = run.bridged("position"), smooth(_lost(run).astype(float), length) != 0.0

    def every(values: Array) -> Array:
        return np.ascontiguousarray(values[rows])

    position = every(smooth(measured, length))
    return BalancedRun(
        name=run.name, time=every(run.time), input=every(smooth(run.input, length)), position=position, angle=position,
        velocity=every(smooth(measured, length, derivative=1, step=step)),
        acceleration=every(smooth(measured, length, derivative=2, step=step)), missing={DRIVING_FORCE: near[rows]},
        start_unknowns=run.start_unknowns, levels=run.levels, start=run.start, start_spread=run.start_spread,
        in_motion=run.in_motion,
    )  # fmt: skip


def _lost(run: Run) -> NDArray[np.bool_]:
    """The rows (n,) in gaps of the position that are longer than those between its updates."""
    lacking = run.missing.get("position", np.zeros(run.time.size, dtype=bool))
    gaps = np.diff(np.flatnonzero(~lacking), prepend=-1, append=run.time.size)
    return lacking & np.repeat(gaps > np.median(gaps), gaps)[: run.time.size] if not lacking.all() else lacking


def _length(run: Run, inertia: float) -> int:
    """The smoothing that errs least: by what it takes off the force, and by the noise in the force of inertia."""
    noise = noise_from_differences(run.masked("position", run.position))
    noise = max(noise, run.quantisation("position") / np.sqrt(12.0))

    def error(length: int) -> float:
        of_inertia = inertia * noise * noise_gain(length, derivative=2, step=run.sample_time)
        return float(np.hypot(taken(run.input, length), of_inertia))

    return min(LENGTHS, key=error)


@dataclass(frozen=True, kw_only=True)
class DrivingForceProblem(Problem):
    """As Problem; what is compared is the driving force along the recorded motion."""

    free: Mapping[str, Noise]  # noise of the recorded signals, of the free runs that a correction is judged by

    def in_free_run(self) -> Problem:
        """The plain problem over whole recordings."""
        return Problem(
            drive=self.drive, simulator=self.simulator, runs=self.whole, whole=self.whole, noise=self.free,
            prior=self.prior, scales=self.scales, filters=self.filters, inflation=self.inflation,
        )  # fmt: skip

    def on(self, runs: Sequence[Run]) -> Problem:
        """The problem on other recordings, judged by their driving force."""
        return replace(self, runs=tuple(balanced(run, self.prior.motor["inertia"]) for run in runs))

    def residuals(self, vector: Array, active: Sequence[int]) -> list[dict[str, Array]]:
        """Recorded minus needed driving force (n,) [N m or N] per run; 0 where it is not compared."""

        def one(run: Run) -> dict[str, Array]:
            assert isinstance(run, BalancedRun)
            left = run.input - self._needed(run, vector, active)
            left[run.not_compared(DRIVING_FORCE)] = 0.0
            return {DRIVING_FORCE: left}

        return side_by_side(one, self.runs)

    def normal_of(self, run: Run, vector: Array, active: Sequence[int], by: Sequence[int]) -> NormalEquations:
        """Normal equations (p, p), (p,) of one run, by central differences: the balance of forces is algebraic."""
        assert isinstance(run, BalancedRun)
        compared = ~run.not_compared(DRIVING_FORCE)
        with np.errstate(over="ignore", invalid="ignore"):  # a law that leaves the range of numbers is not finite
            left = (run.input - self._needed(run, vector, active))[compared] / self.noise[DRIVING_FORCE].level
            slopes = np.zeros((left.size, len(by)))
            for k, place in enumerate(by):
                slopes[:, k] = self._slope(run, vector, active, place)[compared] / self.noise[DRIVING_FORCE].level
            chi2, gradient, curvature = float(left @ left), slopes.T @ left, slopes.T @ slopes
        finite = bool(np.isfinite(chi2) and np.isfinite(curvature).all())
        return NormalEquations(chi2=chi2, gradient=gradient, curvature=curvature, finite=finite, count=left.size)

    def _slope(self, run: BalancedRun, vector: Array, active: Sequence[int], place: int) -> Array:
        """Derivative (n,) of the needed force by one entry of the vector; 0 for what is unknown of a start."""
        if place >= vector.size or place in {u.place for u in run.start_unknowns}:
            return np.zeros(run.time.size)
        step = SLOPE * max(abs(float(vector[place])), SMALL)
        ends = []
        for sign in (1.0, -1.0):
            there = vector.copy()
            there[place] += sign * step
            ends.append(self._needed(run, there, active))
        slope: Array = (ends[0] - ends[1]) / (2.0 * step)
        return slope

    def _needed(self, run: BalancedRun, vector: Array, active: Sequence[int]) -> Array:
        self.work.add(run.time.size)
        return needed_force(
            self.simulator, vector, active, time=run.time, position=run.position, speed=run.velocity,
            acceleration=run.acceleration,
        )  # fmt: skip


def of_driving_force(problem: Problem) -> DrivingForceProblem:
    """The same problem judged by the force that the recorded motion took."""
    runs = tuple(balanced(run, problem.prior.motor["inertia"]) for run in problem.runs)
    noise = noise_of(runs, [{DRIVING_FORCE: r.input} for r in runs])
    return DrivingForceProblem(
        drive=problem.drive, simulator=problem.simulator, runs=runs, whole=problem.whole, noise=noise,
        prior=problem.prior, scales=problem.scales, filters=problem.filters, free=problem.noise,
    )  # fmt: skip
