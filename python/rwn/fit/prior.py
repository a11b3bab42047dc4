"""What is known before a fit: the nominal model's values and how far they are believed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from rwn.model.drives.drive import OneNumber
from rwn.model.model import Model
from rwn.model.vocabulary import Effect, table
from rwn.simulate.own_unknowns import LevelPrior


@dataclass(frozen=True, kw_only=True)
class RunUnknown:
    """What is unknown of one run alone, 0 where nothing is: it adds to one parameter there, or is a level.

    A level is the logarithm of a factor on several parameters, or adds to them.
    """

    name: str
    unit: str
    place: int  # in the vector of a fit, behind all parameters
    parameters: tuple[int, ...]  # what it adds to, or scales
    spread: float  # standard deviation of its prior
    turns: bool = False  # only effects of the angle depend on it
    level: bool = False
    adds: bool = False
    usual: str = ""  # the recording whose level is the machine's; none: the mean of all


@dataclass(frozen=True, kw_only=True)
class Nuisance:
    """An effect of the measurement that every hypothesis fits; `spread`: deviation of the logarithm of each value."""

    effect: str
    values: Mapping[str, float]
    spread: Mapping[str, float]


@dataclass(frozen=True, kw_only=True)
class Prior:
    """Values of the nominal model and declared relative standard deviations (absent: exact)."""

    motor: Mapping[str, float]
    uncertainty: Mapping[str, float]
    effects: Mapping[str, Mapping[str, float]]  # already part of the nominal model
    free: Mapping[str, float]  # unknown without a prior (coefficients), with their first guess
    of_effects: Mapping[str, float] = field(default_factory=dict)  # deviations of `effects`, by "effect.parameter"
    of_runs: tuple[RunUnknown, ...] = ()
    nuisance: tuple[Nuisance, ...] = ()
    starts: tuple[Mapping[str, float], ...] = ()  # other first guesses of what is free, worth a try
    table: Mapping[str, Effect] = field(default_factory=table)  # every effect that the model knows
    one_numbers: tuple[OneNumber, ...] = ()  # pairs of parameters

    @property
    def levels(self) -> tuple[LevelPrior, ...]:
        """What differs from recording to recording."""
        levels = (own for own in self.of_runs if own.level)
        return tuple(dict.fromkeys(LevelPrior(own.parameters, own.spread, own.adds) for own in levels))

    @property
    def added_to(self) -> tuple[str, ...]:
        """The effects whose parameters levels add to: they act in every hypothesis, at 0 where it has no others."""
        places = {p for own in self.of_runs if own.level and own.adds for p in own.parameters}
        return tuple(name for name, e in self.table.items() if places & {e.at(p.name) for p in e.parameters})

    @classmethod
    def of(cls, model: Model) -> Prior:
        """The values of a model with their declared uncertainty."""
        of_effects = {name: std for name, std in model.uncertainty.items() if name in model.effect_values}
        return cls(
            motor=model.motor, uncertainty={n: std for n, std in model.uncertainty.items() if n not in of_effects},
            effects=dict(model.effects), of_effects=of_effects, free={}, table=model.effect_table,
            one_numbers=model.drive.one_numbers,
        )  # fmt: skip
