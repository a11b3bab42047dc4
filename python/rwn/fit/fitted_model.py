"""A model with the values of a fit."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from rwn.fit.fit import Fit
from rwn.fit.intervals import HALF_WIDTH, Estimate
from rwn.model.model import Model
from rwn.model.vocabulary import Parameter, motor_index

VAGUE = 1.0  # relative standard deviation above which an interval leaves open as much as the value


def fitted_model(this: Fit, model: Model) -> Model:
    """`model` with the fitted parameters and effects: what corrected.toml holds."""
    vector = this.vector.copy()
    for u in this.hypothesis.unknowns:
        vector[u.index] = u.within_a_turn(float(vector[u.index]))
    active, known = this.hypothesis.effects, this.hypothesis.table
    replaced = {p.replaces for name in active for p in known[name].parameters}
    names = model.parameters or [p.name for p in model.nominal_parameters]  # of a transfer function without values: all
    parameters = {
        name: model.parameters[name]
        if name in model.parameters and name not in model.uncertainty
        else float(vector[motor_index(name)])
        for name in names
        if name not in replaced
    }
    whole = {name: {p.name: float(vector[known[name].at(p.name)]) for p in known[name].every} for name in active}
    effects = {name: {p.name: values[p.name] for p in known[name].acting(values)} for name, values in whole.items()}
    now = parameters | {f"{name}.{p}": value for name, values in effects.items() for p, value in values.items()}
    # what came out as zero has no relative uncertainty
    uncertainty = {n: std for n, std in model.uncertainty.items() if n in now and (now[n] != 0.0 or np.isinf(std))}
    return replace(model, parameters=parameters, effects=effects, uncertainty=uncertainty)


def with_uncertainty(model: Model, found: Mapping[str, Estimate]) -> Model:
    """`model` with what the intervals say of the parameters of effects of which nothing was declared.

    Deviations are relative, of angles in radians; infinite where an interval leaves open as much as the value.
    """
    doubts = {
        name: _deviation(p, value, found[name].interval)
        for name, (p, value) in model.effect_values.items()
        if name in found and name not in model.uncertainty
    }
    known = {name: float(f"{std:.3g}") for name, std in doubts.items() if std > 0.0}
    return replace(model, uncertainty={**model.uncertainty, **known})


def _deviation(p: Parameter, value: float, interval: tuple[float, float] | None) -> float:
    """A standard deviation by the farther end of a 95 % interval: the nearer one may have been cut at a bound."""
    low, high = interval or (value, value)
    if p.cyclic:
        std = (high - low) / (2.0 * HALF_WIDTH)  # cut at no bound
    elif value == 0.0:
        return np.inf
    elif p.lower > 0.0:
        std = float(np.log(max(high / value, value / low))) / HALF_WIDTH
    else:
        std = max(high - value, value - low) / (HALF_WIDTH * abs(value))
    return std if std <= VAGUE else np.inf
