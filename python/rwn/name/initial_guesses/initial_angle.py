"""First guesses of the angles at which recordings begin, where nothing tells them, of an effect of the angle."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rwn.fit.fit import Fit
from rwn.fit.hypothesis import Hypothesis
from rwn.fit.problem import Problem
from rwn.model.vocabulary import Effect, motor_index
from rwn.simulate.initial_angle import ANGLE, angles_to_try
from rwn.simulate.run import Run

Array = NDArray[np.float64]

FAINT = 1e-3  # of the first guess of a strength: the answer to it is linear, and the motion as it is without


def aligned(problem: Problem, base: Fit, start: Hypothesis, effect: Effect) -> Hypothesis:
    """A start of `base` with an effect of the angle, each recording begun at the angle at which that gains most."""
    if not effect.turns or any(base.hypothesis.table[name].turns for name in base.hypothesis.effects):
        return start
    where = motor_index(ANGLE)
    vector = start.vector.copy()
    for run in problem.runs:
        places = [place for place, parameter in run.own if parameter == where]
        if run.angle_unknown and places:
            vector[places[0]] = _best_angle(problem, run, start, effect)
    return replace(start, vector=vector)


def _best_angle(problem: Problem, run: Run, start: Hypothesis, effect: Effect) -> float:
    """The angle [rad] at which what the effect adds, growing from nothing, explains most of what a run leaves."""
    vector = problem.simulator.started(run, start.vector)
    strengths = [effect.at(p.name) for p in effect.parameters if p.strength and not p.replaces]
    vector[strengths] *= FAINT
    angles = angles_to_try([effect], vector)
    gained = [_gain(problem, run, start, vector, strengths, angle) for angle in angles]
    return float(angles[int(np.argmax(gained))])


def _gain(
    problem: Problem, run: Run, start: Hypothesis, vector: Array, strengths: Sequence[int], angle: float
) -> float:
    """Squared error that a strength of the right sign removes, to first order, beside the uncertain parameters."""
    at = vector.copy()
    at[motor_index(ANGLE)] = angle
    others = [u.index for u in start.unknowns if u.prior is not None and not u.nuisance and u.index not in strengths]
    normal = problem.normal_at(run, at, start.active, [*others, *strengths])
    if not normal.finite or not np.isfinite(normal.curvature).all():
        return -np.inf
    k = len(others)
    size = 1.0 / np.sqrt(np.maximum(np.diag(normal.curvature), 1e-300))
    curvature, gradient = normal.curvature * np.outer(size, size), normal.gradient * size
    kept = curvature[:k, :k] + 1e-9 * np.eye(k)
    left = curvature[k:, k:] - curvature[k:, :k] @ np.linalg.solve(kept, curvature[:k, k:])
    slope = gradient[k:] - curvature[k:, :k] @ np.linalg.solve(kept, gradient[:k])
    return float(np.sum(np.where(slope > 0.0, slope, 0.0) ** 2 / np.maximum(np.diag(left), 1e-9)))
