"""A wavelet network over one state beside the nominal parameters, fitted in free run with exact sensitivities."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType

from rwn import _core
from rwn.fit.hypothesis import Hypothesis, hypothesis
from rwn.fit.problem import Problem
from rwn.model.model import Model
from rwn.unnamed_law.network_formula import NAME, parts_of
from rwn.unnamed_law.places import Place, size_of

STIFF = 3.0  # standard deviation of the weights' prior, of the drive's largest torque or voltage


def has_room(model: Model, parts: int, *, beside: int = 0) -> bool:
    """Whether `parts` own effects more fit in, `beside` effects being active that the model does not have."""
    if model.drive.coefficients or len(model.own_effects) + parts > _core.max_own_effects:
        return False
    return len(model.effects) + beside + parts <= _core.max_active_effects


def knowing(problem: Problem, model: Model) -> Problem:
    """The same problem with the own effects of `model`."""
    own = tuple(effect.core for effect in model.own_effects)
    return replace(
        problem,
        prior=replace(problem.prior, table=model.effect_table),
        simulator=replace(problem.simulator, own=own),
    )


def with_network(
    problem: Problem, model: Model, place: Place, count: int, *, motor: Mapping[str, float],
    weights: Mapping[str, float] = MappingProxyType({}),
    effects: Mapping[str, Mapping[str, float]] = MappingProxyType({}),
) -> tuple[Problem, Hypothesis]:  # fmt: skip
    """The weights of `count` wavelets as unknowns beside the nominal parameters and `effects`, started at these values.

    The problem is `problem` with the network among the effects that it knows.
    """
    parts = parts_of(problem, model, place, count)
    problem = knowing(problem, replace(model, own_effects=(*model.own_effects, *parts)))
    known = {part.name: {p.name: weights[p.name] for p in part.parameters if p.name in weights} for part in parts}
    this = hypothesis(problem.prior, (*effects, *known), problem.scales, {**effects, **known}, motor)
    stiff = STIFF * size_of(problem, place)
    unknowns = tuple(
        replace(u, prior=0.0, prior_std=stiff) if u.name.startswith(NAME) else u for u in this.unknowns
    )
    return problem, replace(this, unknowns=unknowns)
