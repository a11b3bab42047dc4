"""The corrected model and the numbers that go with it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rwn.fit.fit import Fitted
from rwn.fit.residuals import Hypothesis
from rwn.fit.secant import rough
from rwn.model.model import Model
from rwn.model.vocabulary import Effect, motor_index
from rwn.recording.units import linear_unit
from rwn.report.diagnosis import Estimate, FittedParameter, FoundEffect, NominalFit

if TYPE_CHECKING:
    from rwn.name.forward import Explanation

Array = NDArray[np.float64]
AGREEMENT = 1e-3  # relative standard deviation that stays when the noise is averaged out; set on development trials
IDEALISED = 4e-3  # the same for effects whose law idealises a contact; set on the backlashes of trials 10008 to 10010


def deviations(fitted: Fitted, variance: float, correlation_time: float) -> Array:
    """Standard deviations (p) of the unknowns: white-noise covariance widened by the residual's variance and colour."""
    information = fitted.minimum.data_information / (max(variance, 1.0) * correlation_time)
    information = information + (fitted.minimum.information - fitted.minimum.data_information)
    scale = np.sqrt(np.maximum(np.diag(information), 1e-300))
    covariance = np.linalg.pinv(information / np.outer(scale, scale), rcond=1e-13, hermitian=True)
    result: Array = np.sqrt(np.maximum(np.diag(covariance), 0.0)) / scale
    return result


def estimates(fitted: Fitted, variance: float, correlation_time: float) -> dict[str, Estimate]:
    """Value and 95 % interval of every unknown on which something depends, cut at its bounds."""
    seen = np.diag(fitted.minimum.information) > 0.0
    spread = np.hypot(deviations(fitted, variance, correlation_time), _systematic(fitted))
    found = {}
    for u, value, std, known in zip(fitted.candidate.unknowns, fitted.minimum.values, spread, seen, strict=True):
        if u.nuisance or not known:
            continue
        if u.logarithmic and value > 0.0:
            factor = float(np.exp(min(1.96 * std / value, 50.0)))
            interval = (max(value / factor, u.lower), min(value * factor, u.upper))
        else:
            interval = (max(value - 1.96 * std, u.lower), min(value + 1.96 * std, u.upper))
        found[u.name] = Estimate(
            value=float(value), unit=u.unit, interval=(float(interval[0]), float(interval[1]))
        )
    return found


def _systematic(fitted: Fitted) -> Array:
    """What no interval is narrower than, for what noise does not show: a part of each value, of angles in radians."""
    known = fitted.candidate.table
    angles = {f"{name}.{p.name}" for name in fitted.added for p in known[name].parameters if p.cyclic}
    contacts = rough(fitted.candidate)
    pairs = zip(fitted.candidate.unknowns, fitted.minimum.values, strict=True)
    return np.array(
        [
            (IDEALISED if k in contacts else AGREEMENT) * (1.0 if u.name in angles else abs(v))
            for k, (u, v) in enumerate(pairs)
        ]
    )


def _unit_on_an_axis(unknown: str, unit: str, known: Mapping[str, Effect]) -> str:
    """The unit of an unknown of a linear axis; a user has written those of own effects as they are."""
    owner = known.get(unknown.split(".")[0])
    return unit if owner is not None and owner.own else linear_unit(unit)


def found_effects(found: Explanation, chosen: Hypothesis) -> tuple[FoundEffect, ...]:
    """The named effects with parameters, intervals and probability, the one that explains most first."""
    numbers = estimates(chosen.final, found.counted.variance, found.counted.correlation_time)
    known = chosen.final.candidate.table
    if found.setup.whole.angle_per_position != 1.0:
        numbers = {name: replace(e, unit=_unit_on_an_axis(name, e.unit, known)) for name, e in numbers.items()}
    rows = []
    for name in chosen.fitted.added:
        effect = known[name]
        parameters = {
            p.name: numbers[f"{name}.{p.name}"] for p in effect.parameters if f"{name}.{p.name}" in numbers
        }
        for p in effect.parameters:
            if p.fixed:
                parameters[p.name] = Estimate(value=float(chosen.final.vector[effect.at(p.name)]), unit=p.unit)
        rows.append(
            FoundEffect(
                name=name,
                equation=effect.mismatch,
                probability=sum(h.probability for h in found.hypotheses if name in h.fitted.added),
                parameters=parameters,
                formula=effect.equation,
                meaning=effect.meaning,
            )
        )
    alone = {h.fitted.added[0]: h.fitted.cost for h in found.hypotheses if len(h.fitted.added) == 1}
    return tuple(sorted(rows, key=lambda row: alone.get(row.name, np.inf)))


def nominal_fit(found: Explanation, chosen: Hypothesis, model: Model) -> NominalFit:
    """Nominal parameters: as given, refitted alone, and together with the found effects."""
    left, before = found.counted, found.before
    alone = estimates(found.nominal, before.variance, before.correlation_time)
    together = estimates(chosen.final, left.variance, left.correlation_time) if chosen.fitted.added else {}
    rows = {}
    given = dict(model.parameters) or dict(found.setup.nominal.free)
    for name, value in given.items():
        unit = model.unit(name)
        rows[name] = FittedParameter(
            nominal=value,
            uncertainty=model.uncertainty.get(name, 0.0),
            refitted=replace(alone[name], unit=unit) if name in alone else Estimate(value=value, unit=unit),
            corrected=replace(together[name], unit=unit) if name in together else None,
        )
    status = found.nominal.minimum.status
    return NominalFit(parameters=rows, status=status.name.lower().replace("_", "-"), advice=status.value)


def corrected_model(fitted: Fitted, model: Model) -> Model:
    """`model` with the fitted parameters and effects: what corrected.toml holds."""
    vector = fitted.vector
    active, known = fitted.candidate.effects, fitted.candidate.table
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
    uncertainty = {name: value for name, value in model.uncertainty.items() if name in parameters}
    return replace(model, parameters=parameters, effects=effects, uncertainty=uncertainty)
