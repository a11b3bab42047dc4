"""A data sheet that is wrong in one value, whether or not physics is missing besides.

A wrong value is held near itself by its declared uncertainty, so that the search finds whatever physics makes up for it
best. Where even the best explanation moves a value far outside what was declared, the explanations are ranked anew with
that value unknown. If the best one then ends as far off, and is decisively likelier, the data sheet is wrong.
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


def contradicted(ranking: Ranking) -> list[frozenset[str]]:
    """Parameters that the best explanation moved further from the data sheet than is believable, in groups.

    A group is one parameter, or both constants of a motor that are one number. First is the group without whose
    declared uncertainty the explanation fits best.
    """
    best, problem = ranking.fits[0].fit, ranking.problem
    far = [name for name, by in best.moves.items() if by > BELIEVABLE and name in problem.prior.uncertainty]
    groups = {_group(problem, name) for name in far}
    return sorted(groups, key=lambda names: (_released(problem, best, names).cost, sorted(names)))


def without_declared(model: Model, names: Collection[str]) -> Model:
    """The model with nothing known of some parameters beforehand."""
    return replace(model, uncertainty={**model.uncertainty, **dict.fromkeys(names, np.inf)})


def confirmed(free: Ranking, bound: Ranking, model: Model, names: Collection[str]) -> bool:
    """Whether the best explanation, with some parameters free, ends far outside what `model` declares of them.

    It has to be decisively likelier, too, than the best explanation that was held to the declared values, under the
    same noise: where something is missing that has no name here, any free value absorbs some of it.
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
    return 0.5 * left.independent * gained > DECISIVE


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
