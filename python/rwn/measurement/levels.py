"""What differs from recording to recording: friction, as a bearing or a gear is warm in one and cold in the next.

Each recording then has a level of its own, a factor on one quantity, as an unknown of the measurement. Whether they do
differ is asked beside the best explanation, since what is missing of it may differ too.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from rwn import _core
from rwn.fit.fit import Fit, fit
from rwn.fit.hypothesis import hypothesis
from rwn.fit.intervals import AGREEMENT, covariance
from rwn.fit.prior import RunUnknown
from rwn.fit.problem import Problem
from rwn.fit.residuals import statistics
from rwn.model.vocabulary import motor_index
from rwn.simulate.own_unknowns import LevelShare
from rwn.simulate.run import Run

SPREAD = 0.3  # prior deviation of a level's logarithm: friction that halves, as a gear warms up, is 2.3 of it
ITERATIONS = 10  # of a fit that begins near its end
APART = 3.0  # deviations from the mean of all, from which a recording is said to differ: one in 370 by chance


@dataclass(frozen=True, kw_only=True)
class Level:
    """A quantity that may differ from recording to recording."""

    quantity: str
    parameters: tuple[int, ...]  # indices of what a factor on it scales

    def of(self, recording: str) -> str:
        """The name of its unknown of one recording."""
        return f"{self.quantity} of {recording}"


def friction(problem: Problem) -> Level:
    """The level of dry and viscous friction: of the nominal model, and of the effects that take its place."""
    names = problem.drive.friction
    instead = [e for e in problem.prior.table.values() if any(p.replaces in names for p in e.parameters)]
    torques = tuple(e.at(p.name) for e in instead for p in e.parameters if p.unit == "N m") if names else ()
    return Level(quantity="friction", parameters=(*(motor_index(name) for name in names), *torques))


def can_differ(problem: Problem, level: Level) -> bool:
    """Whether there are several recordings of a drive with such a quantity, and it is no unknown of each yet."""
    known = any(own.name == level.of(run.name) for own in problem.prior.of_runs for run in problem.whole)
    return len(problem.whole) > 1 and not known and bool(level.parameters)


def with_levels(problem: Problem, level: Level) -> Problem:
    """The problem with a level of a quantity for each recording among what is unknown.

    A recording has the quantity times its own level over their geometric mean: the mean is the parameter's, which the
    data sheet knows, and no level's.
    """
    first = _core.parameter_count() + len(problem.prior.of_runs)
    names = dict.fromkeys(run.name for run in problem.whole)
    own = [
        RunUnknown(
            name=level.of(name), unit="1", place=first + k, parameters=level.parameters, spread=SPREAD, level=True
        )
        for k, name in enumerate(names)
    ]
    shares = {
        name: tuple(LevelShare(u.place, (u.name == level.of(name)) - 1.0 / len(own), level.parameters) for u in own)
        for name in names
    }

    def placed(runs: Sequence[Run]) -> tuple[Run, ...]:
        return tuple(replace(run, levels=(*run.levels, *shares[run.name])) for run in runs)

    prior = replace(problem.prior, of_runs=(*problem.prior.of_runs, *own))
    return replace(problem, runs=placed(problem.runs), whole=placed(problem.whole), prior=prior)


def beside_levels(problem: Problem, this: Fit, level: Level) -> tuple[Problem, Fit]:
    """The problem with levels, and an explanation refitted beside them."""
    on = with_levels(problem, level)
    begun = hypothesis(on.prior, this.added, on.scales, this.starts(this.added), this.motor)
    return on, fit(on, begun, max_iterations=ITERATIONS)


def uneven(problem: Problem, this: Fit, level: Level) -> dict[str, tuple[float, float]]:
    """The quantity of each recording over its geometric mean, with a deviation, of those that certainly differ."""
    unknowns = [u.name for u in this.hypothesis.unknowns]
    names = [run.name for run in problem.whole if level.of(run.name) in unknowns]
    places = [unknowns.index(level.of(name)) for name in names]
    if not places:
        return {}
    contrasts = np.eye(len(places)) - 1.0 / len(places)
    logarithms = contrasts @ this.minimum.values[places]
    spread = contrasts @ covariance(this, statistics(problem, this))[np.ix_(places, places)] @ contrasts
    # no level is better known than any other number of a fit
    factors, deviations = np.exp(logarithms), np.hypot(np.sqrt(np.maximum(np.diag(spread), 0.0)), AGREEMENT)
    rows = zip(names, factors, deviations, strict=True)
    return {name: (float(f), float(f * d)) for name, f, d in rows if abs(np.log(f)) > APART * d}


def level_beside(problem: Problem, this: Fit, level: Level, run: Run) -> float:
    """The quantity of one recording over that of the machine, as a fit has both."""
    mean, own = this.vector, problem.started(run, this.vector, this.active)
    scaled = [p for p in level.parameters if mean[p] != 0.0]
    return float(own[scaled[0]] / mean[scaled[0]]) if scaled else 1.0
