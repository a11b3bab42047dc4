"""Friction that differs from recording to recording: a bearing or a gear is warm in one and cold in the next.

Each recording then has a level of its own, a factor on all friction, as an unknown of the measurement beside every
hypothesis. Whether they do differ is asked beside the best explanation, since what is missing of it may differ too.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rwn import _core
from rwn.fit.fit import Fit, fit
from rwn.fit.hypothesis import hypothesis
from rwn.fit.intervals import covariance
from rwn.fit.prior import RunUnknown
from rwn.fit.problem import Problem
from rwn.fit.residuals import statistics
from rwn.model.vocabulary import motor_index
from rwn.simulate.run import Run

SPREAD = 0.3  # of a level's logarithm: friction halves as a gear warms up (Bittencourt, Gunnarsson 2012)
ITERATIONS = 10  # of a fit that begins near its end
SURE = 3.0  # deviations from the mean of all, from which it is said of a recording
NAME = "friction of {}"


def can_differ(problem: Problem) -> bool:
    """Whether there are several recordings of a drive with friction, and no levels yet."""
    known = any(own.level for own in problem.prior.of_runs)
    return len(problem.whole) > 1 and not known and bool(_parameters(problem))


def with_levels(problem: Problem) -> Problem:
    """The problem with a level of friction for each recording among what is unknown."""
    first = _core.parameter_count() + len(problem.prior.of_runs)
    names = dict.fromkeys(run.name for run in problem.whole)
    scaled = _parameters(problem)
    own = [
        RunUnknown(name=NAME.format(name), unit="1", place=first + k, parameters=scaled, spread=SPREAD, level=True)
        for k, name in enumerate(names)
    ]
    places = {name: ((u.place, scaled),) for name, u in zip(names, own, strict=True)}

    def placed(runs: Sequence[Run]) -> tuple[Run, ...]:
        return tuple(replace(run, levels=places[run.name]) for run in runs)

    prior = replace(problem.prior, of_runs=(*problem.prior.of_runs, *own))
    return replace(problem, runs=placed(problem.runs), whole=placed(problem.whole), prior=prior)


def beside_levels(problem: Problem, this: Fit) -> tuple[Problem, Fit]:
    """The problem with levels, and an explanation refitted beside them."""
    on = with_levels(problem)
    begun = hypothesis(on.prior, this.added, on.scales, this.starts(this.added), this.motor)
    return on, fit(on, begun, max_iterations=ITERATIONS)


def stated_levels(problem: Problem, this: Fit) -> dict[str, tuple[float, float]]:
    """Friction of each recording over the geometric mean of all, with its deviation, of those that certainly differ."""
    unknowns = this.hypothesis.unknowns
    places = [k for k, u in enumerate(unknowns) if u.level]
    if not places:
        return {}
    contrasts = np.eye(len(places)) - 1.0 / len(places)
    logarithms = contrasts @ this.minimum.values[places]
    spread = contrasts @ covariance(this, statistics(problem, this))[np.ix_(places, places)] @ contrasts
    found = {}
    for k, value, variance in zip(places, logarithms, np.diag(spread), strict=True):
        deviation = float(np.sqrt(max(variance, 0.0)))
        if abs(value) > SURE * deviation:
            factor = float(np.exp(value))
            found[unknowns[k].name.removeprefix(NAME.format(""))] = (factor, factor * deviation)
    return found


def _parameters(problem: Problem) -> tuple[int, ...]:
    """What a level of friction scales: the friction of the nominal model, and of the effects that take its place."""
    friction = problem.drive.friction
    nominal = tuple(motor_index(name) for name in friction)
    instead = [e for e in problem.prior.table.values() if any(p.replaces in friction for p in e.parameters)]
    torques = tuple(e.at(p.name) for e in instead for p in e.parameters if p.unit == "N m")
    return (*nominal, *torques) if friction else ()
