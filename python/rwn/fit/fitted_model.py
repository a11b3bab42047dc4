"""A model with the values of a fit."""

from __future__ import annotations

from dataclasses import replace

from rwn.fit.fit import Fit
from rwn.model.model import Model
from rwn.model.vocabulary import motor_index


def fitted_model(this: Fit, model: Model) -> Model:
    """`model` with the fitted parameters and effects: what corrected.toml holds."""
    vector = this.vector
    active, known = this.hypothesis.effects, this.hypothesis.table
    replaced = {p.replaces for name in active for p in known[name].parameters}
    names = model.parameters or [p.name for p in model.nominal]  # a transfer function without values: all are fitted
    parameters = {
        name: model.parameters[name]
        if name in model.parameters and name not in model.uncertainty
        else float(vector[motor_index(name)])
        for name in names
        if name not in replaced
    }
    effects = {
        name: {p.name: float(vector[known[name].at(p.name)]) for p in known[name].parameters}
        for name in active
    }
    # what came out as zero has no relative uncertainty
    uncertainty = {name: value for name, value in model.uncertainty.items() if parameters.get(name, 0.0) != 0.0}
    return replace(model, parameters=parameters, effects=effects, uncertainty=uncertainty)
