"""A data sheet that is wrong in one value, which the recordings say where nothing is missing as well as where it is.

Priors hold against misfit that lasts, so a value that is far off keeps its effect on the motion, and takes the name of
the physics that makes up for it best. Where the best explanation has to leave what is declared all the same, all are
weighed anew with that value unknown: if the best ends as far off then, and is likelier by far, the sheet is wrong.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import replace

import numpy as np

from rwn.fit.fit import Fit, fit
from rwn.fit.hypothesis import hypothesis
from rwn.fit.prior_weight import BELIEVABLE
from rwn.fit.problem import Problem
from rwn.fit.refitting import refitted_beside
from rwn.fit.residuals import statistics
from rwn.measurement.likelihood import DECISIVE
from rwn.model.model import Model
from rwn.name.ranking import Ranking
from rwn.name.weights import effective_samples


def contradicted(ranking: Ranking) -> list[frozenset[str]]:
    """What the best explanation had to move beyond belief, that first without which it fits best.

    Both constants of a motor where it is one of them.
    """
    best, problem = ranking.fits[0].fit, ranking.problem
    far = [name for name, by in best.moves.items() if by > BELIEVABLE and name in problem.prior.uncertainty]
    groups = {_group(problem, name) for name in far}
    return sorted(groups, key=lambda names: (_released(problem, best, names).cost, sorted(names)))


def without_declared(model: Model, names: Collection[str]) -> Model:
    """The model with nothing known of some parameters beforehand."""
    return replace(model, uncertainty={**model.uncertainty, **dict.fromkeys(names, np.inf)})


def confirmed(free: Ranking, bound: Ranking, model: Model, names: Collection[str]) -> bool:
    """Whether the best explanation leaves what `model` declares of some parameters, now that nothing holds it there.

    And is likelier by far than the best of those that were held to it, under the same noise: where something is missing
    that has no name here, any value that is free absorbs some of it.
    """
    best, problem = free.fits[0].fit, free.problem
    off = [
        abs(np.log(best.motor[name] / model.parameters[name])) / model.uncertainty[name]
        if best.motor[name] > 0.0
        else np.inf
        for name in names
    ]
    if max(off) <= BELIEVABLE:
        return False
    (held,) = refitted_beside([bound.fits[0].fit], _declaring(problem, {n: model.uncertainty[n] for n in names}))
    left = statistics(problem, best)
    gained = (held.cost - best.cost) / (max(left.variance, 1.0) * left.count)
    return 0.5 * effective_samples(left) * gained > DECISIVE


def _group(problem: Problem, name: str) -> frozenset[str]:
    """A parameter, and the one that is the same number of the motor where both were declared."""
    pairs = (frozenset({pair.name, pair.like}) for pair in problem.prior.one_numbers)
    declared = set(problem.prior.uncertainty)
    return next((pair for pair in pairs if name in pair and declared >= pair), frozenset({name}))


def _released(problem: Problem, this: Fit, names: Collection[str]) -> Fit:
    """An explanation fitted with nothing known of some parameters."""
    problem = _declaring(problem, dict.fromkeys(names, np.inf))
    return fit(problem, hypothesis(problem.prior, this.added, problem.scales, this.starts(this.added), this.motor))


def _declaring(problem: Problem, deviations: Mapping[str, float]) -> Problem:
    """The problem with other relative deviations of some parameters."""
    known = {**problem.prior.uncertainty, **deviations}
    return replace(problem, prior=replace(problem.prior, uncertainty=known))
