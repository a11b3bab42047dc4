"""A candidate explanation: nominal model plus some effects, as unknowns of a fit."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from rwn.fit.levenberg_marquardt import DAMPING, Minimum, Unknown, minimise
from rwn.fit.problem import CountedNormal, OutputError
from rwn.model.vocabulary import Effect, Parameter, motor_index, motor_parameters, parameter_vector, table

Array = NDArray[np.float64]

LEAST_LEVEL = 1e-3  # of a friction, relative to the largest torque, that says how strong its elaborations may be
TORQUE_TO_EMF = 0.02  # Kt = Ke in SI but for losses that the equations do not hold
MEASURED = 0.1  # of every recording, that says what a step of a fit costs


@dataclass(frozen=True, kw_only=True)
class Nominal:
    """The nominal model as the fit sees it: values and declared relative standard deviations (absent: exact)."""

    motor: Mapping[str, float]
    uncertainty: Mapping[str, float]
    effects: Mapping[str, Mapping[str, float]]  # already part of the nominal model
    free: Mapping[str, float]  # unknown without a prior (coefficients), with their first guess
    reach: Mapping[str, float] = field(default_factory=dict)  # how far from 0 what is free may go
    starts: tuple[Mapping[str, float], ...] = ()  # other first guesses of what is free, worth a try
    table: Mapping[str, Effect] = field(default_factory=table)  # every effect that the model knows


@dataclass(frozen=True, kw_only=True)
class Candidate:
    """Unknowns and the vector that they are put into."""

    effects: tuple[str, ...]
    vector: Array  # starting values of all parameters
    unknowns: tuple[Unknown, ...]
    table: Mapping[str, Effect] = field(default_factory=table)

    @property
    def active(self) -> list[int]:
        """Indices of the switched-on effects."""
        return [self.table[name].index for name in self.effects]

    @property
    def by(self) -> list[int]:
        """Indices of the unknowns in the parameter vector."""
        return [u.index for u in self.unknowns]

    @property
    def start(self) -> Array:
        """Starting values of the unknowns."""
        return self.vector[self.by]

    def with_values(self, values: Array) -> Array:
        """The whole parameter vector with the unknowns at `values`."""
        vector = self.vector.copy()
        vector[self.by] = values
        return vector

    def starting_at(self, values: Array) -> Candidate:
        """The same candidate from another start."""
        return replace(self, vector=self.with_values(values))


def candidate(
    nominal: Nominal,
    effects: tuple[str, ...],
    scales: Mapping[str, float],
    starts: Mapping[str, Mapping[str, float]] | None = None,
    motor: Mapping[str, float] | None = None,
) -> Candidate:
    """`nominal` plus `effects`, started at their first guesses or at `starts` (SI), the motor at `motor`."""
    starts = starts or {}
    active = tuple(dict.fromkeys((*nominal.effects, *effects)))
    known_effects = nominal.table
    replaced = {p.replaces for name in active for p in known_effects[name].parameters} - {None}
    motor_now = {**nominal.motor, **nominal.free, **(motor or {})}
    unknowns = [_motor_unknown(name, nominal) for name in nominal.uncertainty if name not in replaced]
    unknowns += [_free_unknown(name, nominal.reach.get(name, 1e9)) for name in nominal.free]
    values: dict[str, dict[str, float]] = {}
    for name in active:
        effect = known_effects[name]
        known = nominal.effects.get(name)
        values[name] = {
            p.name: _first(effect, p, motor_now, scales, starts.get(name, {}), known) for p in effect.parameters
        }
        if known is None:
            unknowns += [
                _effect_unknown(effect, p, nominal, scales) for p in effect.parameters if not p.fixed
            ]
    vector = parameter_vector(motor_now, values, known_effects)
    return Candidate(effects=active, vector=vector, unknowns=tuple(unknowns), table=known_effects)


def fit(
    problem: OutputError, this: Candidate, *, max_iterations: int = 60, tolerance: float = 1e-2,
    damping: float = DAMPING, share: float = np.inf,
) -> Minimum:  # fmt: skip
    """Fits the unknowns of a candidate to the recordings, by one iteration at least; `share`: what it may cost."""
    own = problem.metered()

    def evaluate(values: Array) -> CountedNormal:
        return own.normal(this.with_values(values), this.active, this.by)

    def probe(values: Array) -> CountedNormal:
        return own.normal(this.with_values(values), this.active, ())

    end = minimise(
        evaluate, this.start, this.unknowns, max_iterations=max_iterations, tolerance=tolerance, damping=damping,
        prior_scale=problem.colour, probe=probe, enough=lambda: own.work.done >= share,
    )  # fmt: skip
    problem.work.add(own.work.done)
    return end


def cost_of_a_step(problem: OutputError, this: Candidate) -> float:
    """What it costs to simulate all recordings once, with derivatives; measured on the beginning of each."""
    targets = tuple(t.until(max(int(MEASURED * t.time.size), 1)) for t in problem.targets)
    own = replace(problem, targets=targets).metered()
    own.normal(this.vector, this.active, this.by)
    problem.work.add(own.work.done)
    return own.work.done / MEASURED


def _motor_unknown(name: str, nominal: Nominal) -> Unknown:
    value = nominal.motor[name]
    if name not in motor_parameters():  # a coefficient of a transfer function, of either sign
        return replace(_free_unknown(name), prior=value, prior_std=nominal.uncertainty[name])
    parameter = motor_parameters()[name]
    positive = name not in ("viscous_friction", "coulomb_friction", "pendulum_torque") and value > 0.0
    return Unknown(
        name=name,
        unit=parameter.unit,
        index=motor_index(name),
        lower=value * 1e-3 if positive else 0.0,
        upper=value * 1e3 if value > 0.0 else np.inf,
        logarithmic=positive,
        prior=value,
        prior_std=nominal.uncertainty[name],
        tied_to="back_emf_constant" if name == "torque_constant" and _same_constant(nominal) else "",
        tie_std=TORQUE_TO_EMF,
    )


def _same_constant(nominal: Nominal) -> bool:
    """Whether the data sheet leaves room for Kt = Ke, which a brushed motor with a constant field has."""
    pair = ("torque_constant", "back_emf_constant")
    if not all(nominal.uncertainty.get(name, 0.0) > 0.0 for name in pair):
        return False
    ratio = abs(np.log(nominal.motor[pair[0]] / nominal.motor[pair[1]]))
    return bool(ratio < 3.0 * np.hypot(nominal.uncertainty[pair[0]], nominal.uncertainty[pair[1]]))


def _free_unknown(name: str, reach: float = 1e9) -> Unknown:
    if name not in motor_parameters():  # a coefficient of a transfer function
        return Unknown(name=name, unit="", index=motor_index(name), lower=-np.inf, upper=np.inf)
    parameter = motor_parameters()[name]
    return Unknown(name=name, unit=parameter.unit, index=motor_index(name), lower=-reach, upper=reach, nuisance=True)


def _effect_unknown(effect: Effect, p: Parameter, nominal: Nominal, scales: Mapping[str, float]) -> Unknown:
    unit = scales[p.scale]
    known = nominal.motor.get(p.replaces, 0.0) if p.replaces else 0.0
    uncertain = nominal.uncertainty.get(p.replaces, 0.0) if p.replaces else 0.0
    alone = sum(q.replaces == p.replaces for q in effect.parameters) == 1  # two levels for one: neither is known
    has_prior = known > 0.0 and alone and effect.name not in nominal.effects
    return Unknown(
        name=f"{effect.name}.{p.name}",
        unit=p.unit,
        index=effect.at(p.name),
        lower=p.lower * unit,
        upper=max(p.upper * unit, 3.0 * known),
        logarithmic=p.lower > 0.0 and not p.cyclic,
        prior=known if has_prior else None,
        prior_std=max(uncertain, 1e-3) if has_prior else np.inf,
    )


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
    if level > LEAST_LEVEL * scales["torque"] and p.scale == "torque" and p.unit == "N m":
        return level / float(np.mean([q.start for q in effect.parameters if q.replaces]))
    return scales[p.scale]
