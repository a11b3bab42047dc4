"""A hypothesis: the nominal model plus some effects, as unknowns of a fit with the values that it begins from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from rwn.fit.prior import Nuisance, Prior, RunUnknown
from rwn.fit.unknown import Unknown
from rwn.model.checks import bounds_beforehand
from rwn.model.drives.drive import OneNumber
from rwn.model.vocabulary import Effect, Parameter, motor_index, motor_parameters, parameter_vector, table

Array = NDArray[np.float64]

OF_RUNS = "of runs"  # beside the names of effects: starts of what is unknown of single runs
BEYOND_BELIEF = 10.0  # deviations from which a level of one recording is no number to compute with
LEAST_LEVEL = 1e-3  # of a friction, relative to the largest torque, that says how strong its elaborations may be


@dataclass(frozen=True, kw_only=True)
class Hypothesis:
    """Effects, the unknowns that come with them, and the vector that these are put into."""

    effects: tuple[str, ...]  # of the nominal model, then the added ones
    added: tuple[str, ...]
    vector: Array  # starting values of all parameters, and of what is unknown of single runs
    unknowns: tuple[Unknown, ...]
    table: Mapping[str, Effect] = field(default_factory=table)
    taken_over: frozenset[str] = frozenset()  # uncertain nominal parameters that an effect has in its own place
    added_to: tuple[str, ...] = ()  # effects that act through what differs from recording to recording

    @property
    def active(self) -> list[int]:
        """Indices of the switched-on effects."""
        return [self.table[name].index for name in dict.fromkeys((*self.effects, *self.added_to))]

    @property
    def by(self) -> list[int]:
        """Indices of the unknowns in the parameter vector."""
        return [u.index for u in self.unknowns]

    @property
    def start(self) -> Array:
        """Starting values (p,) of the unknowns, in SI."""
        return self.vector[self.by]

    def with_values(self, values: Array) -> Array:
        """The whole parameter vector (all,) with the unknowns at `values` (p,), in SI."""
        vector = self.vector.copy()
        vector[self.by] = values
        return vector

    def starting_at(self, values: Array) -> Hypothesis:
        """The same hypothesis from another start (p,)."""
        return replace(self, vector=self.with_values(values))


def hypothesis(
    prior: Prior,
    added: tuple[str, ...],
    scales: Mapping[str, float],
    starts: Mapping[str, Mapping[str, float]] | None = None,
    motor: Mapping[str, float] | None = None,
) -> Hypothesis:
    """The nominal model with effects `added`, from their first guesses or `starts` (SI), the motor from `motor`.

    `starts`: by effect, and under OF_RUNS by the names of what is unknown of single runs.
    """
    starts = starts or {}
    measured = {n.effect: n for n in prior.nuisance}
    active = tuple(dict.fromkeys((*prior.effects, *measured, *added)))
    known_effects = prior.table
    replaced = {p.replaces for name in active for p in known_effects[name].parameters} - {None}
    motor_now = {**prior.motor, **prior.free, **(motor or {})}
    unknowns = [_motor_unknown(name, prior) for name in prior.uncertainty if name not in replaced]
    unknowns += [_free_unknown(name) for name in prior.free]
    turning = any(known_effects[name].turns for name in active)
    unknowns += [_unknown_of_a_run(own) for own in prior.of_runs if turning or not own.turns]
    values: dict[str, dict[str, float]] = {}
    for name in active:
        effect = known_effects[name]
        known = prior.effects.get(name)
        given = starts.get(name, {})
        acting = effect.acting(given if known is None else known)
        values[name] = {p.name: _first(effect, p, motor_now, scales, given, known) for p in acting}
        if name in measured:
            values[name] |= {p: given.get(p, v) for p, v in measured[name].values.items()}
            unknowns += [_of_measurement(effect, p, measured[name]) for p in effect.parameters if not p.fixed]
        elif known is None:
            unknowns += [_effect_unknown(effect, p, prior, scales) for p in acting if not p.fixed]
        else:
            declared = [(p, prior.of_effects.get(f"{name}.{p.name}", 0.0)) for p in acting]
            unknowns += [_declared_unknown(effect, p, known[p.name], std) for p, std in declared if std > 0.0]
    of_runs = [starts.get(OF_RUNS, {}).get(own.name, 0.0) for own in prior.of_runs]
    vector = np.append(parameter_vector(motor_now, values, known_effects), of_runs)
    return Hypothesis(
        effects=active, added=added, vector=vector, unknowns=tuple(unknowns), table=known_effects,
        taken_over=frozenset(prior.uncertainty) & replaced, added_to=prior.added_to,
    )  # fmt: skip


def _motor_unknown(name: str, prior: Prior) -> Unknown:
    value = prior.motor[name]
    if name not in motor_parameters():  # a coefficient of a transfer function
        return replace(_free_unknown(name), prior=value, prior_std=prior.uncertainty[name])
    parameter = motor_parameters()[name]
    tie = next((pair for pair in prior.one_numbers if pair.name == name and _may_be_one(pair, prior)), None)
    positive = parameter.lower > 0.0 and value > 0.0  # else it may be 0: a friction, a load
    return Unknown(
        name=name,
        unit=parameter.unit,
        index=motor_index(name),
        lower=value * 1e-3 if positive else 0.0,
        upper=value * 1e3 if value > 0.0 else np.inf,
        logarithmic=positive,
        prior=value,
        prior_std=prior.uncertainty[name],
        tied_to=tie.like if tie else "",
        tie_std=tie.spread if tie else np.inf,
    )


def _may_be_one(pair: OneNumber, prior: Prior) -> bool:
    """Whether the data sheet leaves room for it."""
    one, other = (prior.uncertainty.get(name, 0.0) for name in (pair.name, pair.like))
    if min(one, other) <= 0.0:
        return False
    ratio = abs(np.log(prior.motor[pair.name] / prior.motor[pair.like]))
    return bool(ratio < 3.0 * np.hypot(one, other))


def _free_unknown(name: str) -> Unknown:
    """A coefficient of a transfer function, of either sign."""
    return Unknown(name=name, unit="", index=motor_index(name), lower=-np.inf, upper=np.inf)


def _of_measurement(effect: Effect, p: Parameter, nuisance: Nuisance) -> Unknown:
    value = nuisance.values[p.name]
    return Unknown(
        name=f"{effect.name}.{p.name}", unit=p.unit, index=effect.at(p.name), lower=1e-3 * value, upper=1e3 * value,
        logarithmic=True, prior=value, prior_std=nuisance.spread[p.name], nuisance=True,
    )  # fmt: skip


def _unknown_of_a_run(own: RunUnknown) -> Unknown:
    most = BEYOND_BELIEF * own.spread if own.level else np.inf
    return Unknown(
        name=own.name, unit=own.unit, index=own.place, lower=-most, upper=most, prior=0.0, prior_std=own.spread,
        nuisance=True, level=own.level,
    )  # fmt: skip


def _effect_unknown(effect: Effect, p: Parameter, prior: Prior, scales: Mapping[str, float]) -> Unknown:
    unit = p.scale.of(scales)
    known = prior.motor.get(p.replaces, 0.0) if p.replaces else 0.0
    uncertain = prior.uncertainty.get(p.replaces, 0.0) if p.replaces else 0.0
    alone = sum(q.replaces == p.replaces for q in effect.parameters) == 1  # two levels for one: neither is known
    has_prior = known > 0.0 and alone and effect.name not in prior.effects
    return Unknown(
        name=f"{effect.name}.{p.name}",
        unit=p.unit,
        index=effect.at(p.name),
        lower=p.lower * unit,
        upper=max(p.upper * unit, 3.0 * known),
        logarithmic=p.logarithmic,
        prior=known if has_prior else None,
        prior_std=max(uncertain, 1e-3) if has_prior else np.inf,
        amplitude=_amplitude(effect, p.line) if p.cyclic else "",
        cyclic=p.cyclic,
    )


def _amplitude(effect: Effect, line: int) -> str:
    """Name of the unknown that is the amplitude of a line of the effect's oscillation; empty: it has none."""
    strengths = [p for p in effect.every if p.line == line and p.strength and p.lower == 0.0]
    return f"{effect.name}.{strengths[0].name}" if len(strengths) == 1 else ""


def _declared_unknown(effect: Effect, p: Parameter, value: float, std: float) -> Unknown:
    """Of an effect of the nominal model; `std`: relative, of an angle in radians."""
    lower, upper = (-np.inf, np.inf) if p.cyclic else bounds_beforehand(p)
    if p.logarithmic and value > 0.0:
        lower, upper = max(lower, 1e-3 * value), min(upper, 1e3 * value)
    return Unknown(
        name=f"{effect.name}.{p.name}", unit=p.unit, index=effect.at(p.name), lower=min(lower, value),
        upper=max(upper, value), logarithmic=p.logarithmic, prior=value,
        prior_std=std / abs(value) if p.cyclic and value else std, cyclic=p.cyclic,
    )  # fmt: skip


def _first(
    effect: Effect,
    p: Parameter,
    motor: Mapping[str, float],
    scales: Mapping[str, float],
    start: Mapping[str, float],
    known: Mapping[str, float] | None,
) -> float:
    if p.name in start:
        return start[p.name]
    if known is not None:
        return known.get(p.name, p.start if p.fixed else 0.0)
    return p.start * first_unit(effect, p, motor, scales)


def first_unit(effect: Effect, p: Parameter, motor: Mapping[str, float], scales: Mapping[str, float]) -> float:
    """What first guesses of a parameter are multiples of: its scale, or the level of the motor that it takes over."""
    replaced = next((q.replaces for q in effect.parameters if q.replaces), None)
    level = motor.get(replaced, 0.0) if replaced else 0.0
    if level > LEAST_LEVEL * scales["torque"] and p.scale.powers == {"torque": 1} and p.unit == "N m":
        return level / float(np.mean([q.start for q in effect.parameters if q.replaces]))
    return p.scale.of(scales)
