"""The places at which a wavelet network promises most: what each explains of a residual to first order.

A torque drives the speed as the linear drive does (`rwn.simulate.linear_response`); a voltage lost in the winding is a
current at standstill, and the torque of that. Each wavelet or harmonic goes through that filter as a regressor; one
simulation serves all places.
"""

from __future__ import annotations

from collections.abc import Container, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rwn.fit.fit import Fit
from rwn.fit.problem import Problem
from rwn.model.drives.drive import Drive
from rwn.model.vocabulary import motor_values
from rwn.recording.signals import DRIVING_FORCE
from rwn.simulate.linear_response import speed_filter
from rwn.simulate.run import Run
from rwn.simulate.unknown_inputs import unknown_inputs
from rwn.unnamed_law.network_formula import basis_at
from rwn.unnamed_law.places import FACTORS, Place

Array = NDArray[np.float64]

KEPT = 8  # places that are worth a fit each: the order to first order is not that of the fits


def most_promising(problem: Problem, this: Fit, places: Sequence[Place], count: int) -> list[Place]:
    """The KEPT places at which a network of `count` wavelets explains most of what a fit leaves, the best first."""
    residuals = problem.residuals(this.vector, this.active)
    pairs = list(zip(problem.runs, residuals, strict=True))
    answers = [_Answers.of(problem, this, run, tuple(_compared_signals(left))) for run, left in pairs]
    left = np.concatenate([a.weighted(r) for a, r in zip(answers, residuals, strict=True)])
    nominal, _ = np.linalg.qr(np.concatenate([a.of_nominal() for a in answers]))
    left = left - nominal @ (nominal.T @ left)

    def explained(place: Place) -> float:
        waves = basis_at(place, [a.states[place.state] for a in answers], count)
        columns = np.concatenate([a.of_network(place, w) for a, w in zip(answers, waves, strict=True)])
        columns -= nominal @ (nominal.T @ columns)
        own, size, _ = np.linalg.svd(columns, full_matrices=False)
        return float(np.sum((own[:, size > 1e-6 * max(size[0], 1e-300)].T @ left) ** 2))

    return sorted(places, key=explained, reverse=True)[:KEPT]


def _compared_signals(residual: dict[str, Array]) -> list[str]:
    """The signals that are looked at: a position adds up what the speed shows already."""
    return [s for s in residual if s != "position"] or list(residual)


@dataclass(frozen=True, kw_only=True)
class _Answers:
    """How one run's signals answer a torque or a voltage, to first order."""

    signals: tuple[str, ...]
    noise: dict[str, float]
    states: dict[str, Array]  # (n,) each
    acceleration: Array
    step: float
    filter: tuple[float, float]  # of the speed's answer to a torque
    drive: Drive
    motor: dict[str, float]
    uncertain: Container[str]  # parameters of the nominal model that a fit may move

    @classmethod
    def of(cls, problem: Problem, this: Fit, run: Run, signals: tuple[str, ...]) -> _Answers:
        seen = unknown_inputs(problem.drive, problem.simulator, run, this.vector)
        return cls(
            signals=signals, noise={s: problem.noise[s].deviation for s in signals},
            states={
                "time": run.time, "input": run.input, "speed": seen.speed, "current": seen.current,
                "position": run.angle if run.angle.size else np.zeros(run.time.size),
            },
            acceleration=seen.acceleration, step=run.sample_time,
            filter=speed_filter(problem.drive, this.vector, run.sample_time),
            drive=problem.drive, motor={name: float(value) for name, value in motor_values(this.vector).items()},
            uncertain=problem.prior.uncertainty.keys(),
        )  # fmt: skip

    def weighted(self, signals: dict[str, Array]) -> Array:
        """Columns (n,) or (n, m) by signal, stacked, in units of the noise."""
        return np.concatenate([signals[s] / self.noise[s] for s in self.signals])

    def of_nominal(self) -> Array:
        """The answers to what the uncertain parameters of the nominal model scale, and to a start at another speed."""
        speed = self.states["speed"]
        of = self.states | {"direction": np.sign(speed), "acceleration": self.acceleration}
        places = [place for name, place in self.drive.terms.items() if name in self.uncertain]
        start = np.zeros(speed.size)
        start[0] = 1.0 / self.filter[1]
        torques = [of[state] for term, state in places if term == "torque"]
        columns = [self._to_torque(np.column_stack([start, *torques]))]
        voltages = [of[state] for term, state in places if term == "drop"]
        if voltages:
            columns.append(self._to_voltage(np.column_stack(voltages)))
        return np.column_stack(columns)

    def of_network(self, place: Place, waves: Array) -> Array:
        """The answers to each wavelet (n, m) at a place."""
        factor = self.states[place.factor][:, None] * waves if place.factor else waves
        if place.of_a_sensor:
            nothing = np.zeros(waves.shape)
            return self.weighted({s: factor if s == place.term else nothing for s in self.signals})
        if place.term in FACTORS:
            current, speed = self.states["current"][:, None], self.states["speed"][:, None]
            given = self.states["input"][:, None]
            torque = self._to_torque(self.drive.driving_torque(self.motor, current, given) * waves)
            return torque + self._to_voltage(self.drive.back_emf(self.motor, speed) * waves)
        if place.term == "drop":
            return self._to_voltage(factor)
        return self._to_torque(-np.sign(self.states["speed"])[:, None] * factor if place.term == "friction" else factor)

    def _to_voltage(self, lost: Array) -> Array:
        nothing = np.zeros(lost.shape)
        current = self.drive.resting_current(self.motor, nothing, -lost)
        return self._to_torque(self.drive.driving_torque(self.motor, current, nothing), current)

    def _to_torque(self, torque: Array, current: Array | float = 0.0) -> Array:
        """The answers to a torque (n, m), of which `current` flows before the motor turns."""
        from scipy.signal import lfilter  # late: the command line starts without it

        a, b = self.filter
        speed = lfilter([0.0, b], [1.0, -a], torque, axis=0)
        position = self.step * np.cumsum(speed, axis=0)
        answers = {"speed": speed, "position": position, DRIVING_FORCE: torque}
        if self.drive.winding:
            answers["current"] = current + self.drive.resting_current(self.motor, speed, np.zeros(speed.shape))
        return self.weighted(answers)
