"""Whether a recording that was not fitted contradicts those that were in one quantity alone."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rwn.fit.fit import Fit
from rwn.fit.problem import Problem
from rwn.fit.residuals import Statistics, join, statistics_of, structured_of
from rwn.measurement.levels import Level, all_levels, is_known, level_off, level_spread
from rwn.simulate.level import nearest_levels
from rwn.simulate.own_unknowns import LevelPrior
from rwn.simulate.run import Run

Array = NDArray[np.float64]

ANYTHING = 10.0  # prior deviations of a level of another machine over those of one


class UnseenLevel(NamedTuple):
    """A recording that was not fitted, at the level of a quantity that fits it best."""

    level: Level
    prior: LevelPrior
    off: float  # the quantity over that of the machine; less it, of what is added
    left: Statistics


def explained_by_a_level(problem: Problem, this: Fit, run: Run) -> UnseenLevel | None:
    """The one quantity whose level explains all that a fit leaves of an unseen recording; None: there is none."""
    on = problem.on([run])
    (judged,) = on.runs
    active, table = this.active, problem.prior.table
    begun = on.started(judged, this.vector, active)
    if _left(on, begun, active).at_the_floor:
        return None
    found = list[UnseenLevel]()
    for level in (level for level in all_levels(problem) if level.parameters and not is_known(problem, level)):
        places = set(level.parameters) if level.adds else set[int]()
        acting = [e.index for e in table.values() if places & {e.at(p.name) for p in e.parameters}]
        switched = [*active, *(k for k in acting if k not in active)]
        spread = level_spread(problem, level)
        prior = LevelPrior(level.parameters, ANYTHING * spread, level.adds)
        vector = nearest_levels(on.simulator, judged, begun, switched, [prior], noise=on.noise)
        found.append(UnseenLevel(level, prior, level_off(level, begun, vector), _left(on, vector, switched)))
    explaining = [one for one in found if one.left.at_the_floor]
    return min(explaining, key=lambda one: one.left.variance, default=None)


def _left(problem: Problem, vector: Array, active: Sequence[int]) -> Statistics:
    """What runs leave that start as they are at a parameter vector (all,)."""
    residuals = [
        {s: run.signal(s) - made[s] for s in run.recorded}
        for run in problem.runs
        for made in [problem.simulator.simulate(run, vector, active).signals]
    ]
    joined = join(problem, residuals)
    return statistics_of(joined, structured=structured_of(joined))
