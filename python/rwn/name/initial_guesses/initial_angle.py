"""First guesses of the angles at which recordings begin, where nothing tells them, of an effect of the angle."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rwn.fit.fit import Fit
from rwn.fit.hypothesis import Hypothesis
from rwn.fit.problem import Problem
from rwn.model.initial_state import INITIAL_POSITION
from rwn.model.vocabulary import Effect, motor_index
from rwn.name.initial_guesses.guess import Guess
from rwn.simulate.nearest_angle import angles_to_try
from rwn.simulate.run import Run

Array = NDArray[np.float64]

FAINT = 1e-3  # of the first guess of a strength: the answer to it is linear, and the motion as it is without


def free_to_turn(problem: Problem, base: Fit, effect: Effect) -> bool:
    """Whether an effect may begin at any angle in some recording, as far as is known beside `base`."""
    turning = any(base.hypothesis.table[name].turns for name in base.hypothesis.effects)
    return effect.turns and not turning and any(_place(run) is not None for run in problem.runs)


def without_phases(guesses: Sequence[Guess], effect: Effect) -> list[Guess]:
    """The guesses without those that differ from another in the phase alone."""
    cyclic = {p.name for p in effect.parameters if p.cyclic}
    kept = {tuple((k, v) for k, v in guess.items() if k not in cyclic): guess for guess in reversed(guesses)}
    return list(kept.values())[::-1]


def aligned(problem: Problem, start: Hypothesis, effect: Effect) -> Hypothesis:
    """A start with the phase, and the unknown angle of every recording, at which the effect gains most.

    Recordings whose angle is known share the phase.
    """
    vector = start.vector.copy()
    known = [run for run in problem.runs if _place(run) is None]
    phase = None if effect.own else next((p for p in effect.parameters if p.cyclic), None)
    turned = _best_angle(problem, known, start, effect) if known and phase else 0.0
    for run in problem.runs:
        place = _place(run)
        if place is not None:
            vector[place] = _best_angle(problem, [run], start, effect) - turned
    if phase:
        at = effect.at(phase.name)
        vector[at] = np.angle(np.exp(1j * (vector[at] + _order(effect, vector) * turned)))
    return replace(start, vector=vector)


def _order(effect: Effect, vector: Array) -> float:
    """Periods per revolution of an effect."""
    return next((float(vector[effect.at(p.name)]) for p in effect.parameters if p.order), 1.0)


def _place(run: Run) -> int | None:
    """Of the unknown angle of a run in the vector of a fit."""
    where = motor_index(INITIAL_POSITION)
    return next((u.place for u in run.start_unknowns if u.parameter == where and run.angle_unknown), None)


def _best_angle(problem: Problem, runs: Sequence[Run], start: Hypothesis, effect: Effect) -> float:
    """The angle [rad] at which what the effect adds, growing from nothing, explains most of what some runs leave."""
    strengths = [effect.at(p.name) for p in effect.parameters if p.strength and not p.replaces]
    phases = [effect.at(p.name) for p in effect.parameters if p.cyclic]
    vectors = []
    for run in runs:
        vector = problem.simulator.started(run, start.vector)
        vector[strengths] *= FAINT
        vectors.append(vector)

    def normal(angle: float, by: Sequence[int]) -> tuple[Array, Array]:
        """Gradient (p,) and curvature (p, p) of the squared error by parameters, runs begun at an angle."""
        slope, curvature = np.zeros(len(by)), np.zeros((len(by), len(by)))
        for run, vector in zip(runs, vectors, strict=True):
            vector[motor_index(INITIAL_POSITION)] = angle
            one = problem.normal_at(run, vector, start.active, by)
            if not one.finite:
                return np.full(len(by), -np.inf), curvature
            slope, curvature = slope + one.gradient, curvature + one.curvature
        return slope, curvature

    def gain(angle: float) -> float:
        """Squared error that strengths of the right sign remove, to first order."""
        slope, curvature = normal(angle, strengths)
        return float(np.sum(np.maximum(slope, 0.0) ** 2 / np.maximum(np.diag(curvature), 1e-300)))

    if len(phases) == len(strengths) == 1 and not effect.own:  # whose periods per revolution its formula hides
        _, phase = sine_of(*normal(0.0, [*strengths, *phases]), vectors[0][strengths[0]])
        return phase / _order(effect, vectors[0])
    return float(max(angles_to_try([effect], vectors[0]), key=gain))


def sine_of(slope: Array, curvature: Array, amplitude: float) -> tuple[float, float]:
    """Amplitude and phase [rad], beside its own, at which A sin or A cos removes most of the squared error.

    By normal equations (2,), (2, 2) by amplitude and phase: the derivative by the phase is A times the same law a
    quarter of a period on, so that any phase is a combination of the two.
    """
    if not (amplitude and np.isfinite(slope).all()):
        return 0.0, 0.0
    unit = np.array([1.0, 1.0 / amplitude])
    cosine, sine = np.linalg.lstsq(curvature * np.outer(unit, unit), slope * unit)[0]
    return float(np.hypot(sine, cosine)), float(np.arctan2(sine, cosine))
