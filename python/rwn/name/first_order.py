"""What a start of a fit leaves to first order, before anything is fitted: one simulation of each tells starts apart.

What is missing has bent the unknowns of what it stands beside. Seen across the directions in which these move the
simulation, and with its own strength free, a start shows what it explains that they cannot (Rao 1948, score test).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rwn.fit.fit import Fit
from rwn.fit.hypothesis import Hypothesis
from rwn.fit.problem import Problem
from rwn.fit.secant import SECANTS, slopes_by_secants, weighted_errors
from rwn.simulate.simulator import RAN_AWAY

Array = NDArray[np.float64]

FARTHEST = 3.0  # factor by which a strength may differ from its guess, as in one step of a fit
ALIKE = 1.1  # factor on the squared error within which a first order tells nothing apart
FLAT = 1e-4  # directions that move the simulation less than the strongest by this factor do not count


class FirstOrderCost(NamedTuple):
    """What a start leaves; of those that are alike to first order the nearest is the least."""

    steps: float  # of ALIKE, squared error to first order
    error: float  # squared error as it stands


class FirstOrder:
    """A fit, and the directions (n, q) in which its unknowns move what it leaves."""

    def __init__(self, problem: Problem, base: Fit) -> None:
        self._problem, self._beside = problem, set(base.hypothesis.effects)
        values = base.minimum.values
        slopes = slopes_by_secants(problem, base.hypothesis, values, SECANTS[-1])
        lengths = np.linalg.norm(slopes, axis=0)
        seen = np.isfinite(lengths) & (lengths > 0.0)
        directions, size, _ = np.linalg.svd(slopes[:, seen] / lengths[seen], full_matrices=False)
        self._directions = directions[:, size > FLAT * np.max(size, initial=0.0)]
        self._left = self._across(weighted_errors(problem, base.hypothesis, values))

    def left_by(self, start: Hypothesis) -> FirstOrderCost:
        """What a start leaves; infinite where its simulation runs away."""
        errors = weighted_errors(self._problem, start, start.start)
        if not np.isfinite(errors).all() or float(np.max(np.abs(errors), initial=0.0)) > RAN_AWAY**0.5:
            return FirstOrderCost(np.inf, np.inf)
        added = self._left - self._across(errors)
        energy = float(added @ added)
        strength = float(added @ self._left) / energy if energy else 1.0
        sign = -1.0 if strength < 0.0 and self._either_way(start) else 1.0
        strength = sign * float(np.clip(sign * strength, 1.0 / FARTHEST, FARTHEST))
        left = float(np.sum((self._left - strength * added) ** 2))
        return FirstOrderCost(float(np.floor(np.log(max(left, 1e-300)) / np.log(ALIKE))), float(errors @ errors))

    def _either_way(self, start: Hypothesis) -> bool:
        """Whether what a start adds may act with either sign, whatever that of its guess."""
        new = [start.table[name] for name in start.effects if name not in self._beside]
        return all(p.lower < 0.0 for effect in new for p in effect.parameters if p.strength)

    def _across(self, errors: Array) -> Array:
        across: Array = errors - self._directions @ (self._directions.T @ errors)
        return across
