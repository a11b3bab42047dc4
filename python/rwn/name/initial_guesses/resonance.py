"""First guesses of a second mass, read off a residual: where it rings, how long, and how much of the inertia rings.

Two masses on a spring, J - J_L and J_L, move as one mass J does, and beside it against each other. Of the motor's speed

    J w / T = 1 / s + J_L / (J - J_L) s / (s^2 + 2 zeta w0 s + w0^2)

(modal form of the two-mass drive; Schroeder, Elektrische Antriebe). The acceleration of one mass, as simulated, passed
through the second part is therefore what the speed lacks, and its size says how much is behind the spring.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rwn.fit.fit import Fit
from rwn.fit.problem import Problem
from rwn.model.vocabulary import Effect, motor_index
from rwn.name.initial_guesses.guess import Guess
from rwn.simulate.linear_response import speed_filter

Array = NDArray[np.float64]

RATES = 100  # natural frequencies that are tried, up to the highest that is sampled
SLOWEST = 6.0  # lowest natural frequency that is tried, in periods per longest recording
RATIOS = (0.03, 0.1, 0.3)  # damping ratios that are tried with each natural frequency
BEHIND = (0.05, 0.9)  # least and largest share of the inertia that may be behind the spring


class Resonance(NamedTuple):
    """A spring between two masses."""

    rate: float  # natural frequency of the masses against each other, rad/s
    damping_ratio: float
    behind: float  # part of the inertia

    def of(self, inertia: float) -> tuple[float, float, float]:
        """Stiffness [N m/rad], damping [N m s/rad] and inertia of the load [kg m^2], of so much inertia in all."""
        reduced = self.behind * (1.0 - self.behind) * inertia
        return reduced * self.rate**2, 2.0 * self.damping_ratio * reduced * self.rate, self.behind * inertia


class _Part(NamedTuple):
    """One recording, without what another inertia, another motor constant or an offset would change."""

    acceleration: Array  # of one mass, as simulated, less what the back-EMF takes of it
    error: Array  # of the speed
    basis: Array  # orthonormal, of what was taken out
    step: float


def read(problem: Problem, base: Fit, effect: Effect, count: int) -> list[Guess] | None:  # noqa: ARG001
    """Stiffness, damping and inertia of a second mass, told by their units; None where the residual does not ring."""
    residuals = problem.residuals(base.vector, base.active)
    inertia = float(base.vector[motor_index("inertia")])
    of = {p.unit: p.name for p in effect.parameters}
    names = of["N m/rad"], of["N m s/rad"], of["kg m^2"]
    found = [dict(zip(names, r.of(inertia), strict=True)) for r in resonances(problem, base.vector, residuals)]
    return list(found) or None


def resonances(
    problem: Problem, motor: Array, residuals: Sequence[dict[str, Array]], count: int = 2
) -> list[Resonance]:
    """The resonances that explain most of the speed residual, best first; none without a free run of a recorded speed.

    `motor`: parameter vector of the model with one mass that left `residuals`, a dict of (n,) for each recording.
    """
    parts = list(_parts(problem, motor, residuals))
    if not parts:
        return []
    longest = max(p.error.size * p.step for p in parts)
    rates = np.geomspace(2.0 * np.pi * SLOWEST / longest, np.pi / min(p.step for p in parts), RATES)
    found = np.array([[_answer(parts, rate, ratio) for ratio in RATIOS] for rate in rates])
    gains, ratios = found[:, :, 0].max(axis=1), found[:, :, 0].argmax(axis=1)
    peaks = [k for k in np.argsort(-gains) if gains[k] > 0.0 and gains[k] == gains[max(k - 1, 0) : k + 2].max()]
    sizes = found[np.arange(RATES), ratios, 1]
    behind = np.clip(sizes / (1.0 + sizes), *BEHIND)
    return [Resonance(float(rates[k]), RATIOS[ratios[k]], float(behind[k])) for k in peaks[:count]]


def _parts(problem: Problem, motor: Array, residuals: Sequence[dict[str, Array]]) -> Iterator[_Part]:
    from scipy.signal import lfilter  # late: the command line starts without it

    for run, residual in zip(problem.runs, residuals, strict=True):
        if "speed" not in residual or run.restart_every:  # where the motion restarts nothing rings for long
            continue
        speed, step = run.speed - residual["speed"], run.sample_time
        a, b = speed_filter(problem.drive, motor, step)
        acceleration = np.diff(speed, append=speed[-1]) / step
        lag = lfilter([0.0, b], [1.0, -a], acceleration)
        basis, _ = np.linalg.qr(np.stack([speed, lag, np.ones(speed.size)], axis=1))
        error = residual["speed"] - basis @ (basis.T @ residual["speed"])
        driven = acceleration + np.log(a) / step * residual["speed"]  # by what the back-EMF really leaves
        yield _Part(lfilter([1.0, -1.0], [1.0, -a], driven), error, basis, step)


def _answer(parts: Sequence[_Part], rate: float, ratio: float) -> tuple[float, float]:
    """Energy of the errors that a resonance explains, and its size J_L / (J - J_L); 0 where that is negative."""
    from scipy.signal import lfilter  # late: the command line starts without it

    pole = rate * complex(-ratio, np.sqrt(1.0 - ratio**2))
    weight = pole / (pole - pole.conjugate())  # s / (s^2 + 2 zeta w0 s + w0^2) = 2 Re weight / (s - pole)
    load = size = 0.0
    for part in parts:
        turn = np.exp(pole * part.step)
        gain = weight * (turn - 1.0) / pole  # the input held over a step
        ring = lfilter(
            [0.0, 2.0 * gain.real, -2.0 * (gain * np.conj(turn)).real], [1.0, -2.0 * turn.real, abs(turn) ** 2],
            part.acceleration,
        )  # fmt: skip
        ring -= part.basis @ (part.basis.T @ ring)
        load += float(ring @ part.error)
        size += float(ring @ ring)
    return (load**2 / size, load / size) if load > 0.0 else (0.0, 0.0)
