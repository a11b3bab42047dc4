"""A model of a drive: nominal parameters and how sure one is of them, effects, layout of recordings."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from html import escape
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import NDArray

from rwn.errors import InputError, unrecognised
from rwn.fields import check_fields
from rwn.model import drives, vocabulary
from rwn.model.checks import (
    LARGEST,
    LARGEST_COEFFICIENT,
    check_effect,
    check_nominal,
    check_numbers,
    check_site,
    check_uncertainty,
)
from rwn.model.drives.drive import Drive, NominalParameter, refused_linear
from rwn.model.own_effects import OwnEffect, check_constants, check_own_effects, with_own
from rwn.model.vocabulary import Effect, Parameter
from rwn.recording.layout import Layout
from rwn.values import Shown, table_of_rows

if TYPE_CHECKING:
    import pandas

COLUMNS = ("parameter", "value", "uncertainty", "unit")  # of `Model.table`


class EffectParameter(Protocol):
    """What is read of one parameter of an effect."""

    @property
    def name(self) -> str:
        """Its name."""
    @property
    def unit(self) -> str:
        """Its SI unit."""
    @property
    def fixed(self) -> bool:
        """Whether it is a constant, never fitted."""


GRAVITY = 9.80665  # standard gravity [m/s^2]
LOADS = {
    "pendulum": (
        NominalParameter(name="mass", unit="kg", meaning="mass of the pendulum", positive=True),
        NominalParameter(name="length", unit="m", meaning="from the axis to its centre of mass", positive=True),
    )
}


@dataclass(frozen=True, kw_only=True, repr=False)
class Model(Shown):
    """A drive of a `kind` (docs/models.md) with its nominal `parameters` (SI).

    `effects`: name -> parameter values (SI); `own_effects`: those that the user defines; `load`: known loads, name ->
    parameter values (SI). `linear`: moves along a line, in m, m/s and N. `recording`: where a recording's signals
    stand, and how they were measured. `source`: the file that the model was read from.

    `uncertainty`: relative standard deviations of parameters, of those of effects as "effect.parameter" (of angles: in
    rad); at most 3, or infinite: nothing is known; not listed: exact.

    Kind `lti`: parameters b0, b1, .. and a0, .. are the coefficients of s^0, s^1, .. of a transfer function
    of `order`, monic in its denominator; where they are not given they are estimated.

    Raises InputError where a kind, a parameter or an effect is named that there is not.
    """

    kind: str
    parameters: Mapping[str, float]
    uncertainty: Mapping[str, float] = field(default_factory=dict)
    effects: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    own_effects: tuple[OwnEffect, ...] = ()
    load: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    linear: bool = False
    order: int = 0
    recording: Layout = field(default_factory=Layout)
    source: str = field(default="", compare=False)

    def __post_init__(self) -> None:
        check_fields(self, where=str(self.source or "model"), numbers=False)
        if self.kind not in drives.KINDS:
            raise unrecognised("kind", self.kind, drives.KINDS, where=self.source or "model")
        most = drives.MOST_ORDER if drives.KINDS[self.kind].coefficients else 0
        if isinstance(self.order, bool) or not isinstance(self.order, int) or not min(most, 1) <= self.order <= most:
            raise InputError(
                f"order is {self.order!r}", where=self.source or "model", fix="correct order, or leave it out",
                expected=f"a whole number from 1 to {most}" if most else f"none, for a drive of kind {self.kind}",
            )  # fmt: skip
        if self.linear and drives.KINDS[self.kind].on_a_line is None:
            on_a_line = [kind for kind, drive in drives.KINDS.items() if drive.on_a_line]
            raise refused_linear(self.linear, self.source or "model", on_a_line)
        for name in ("parameters", "uncertainty"):
            object.__setattr__(self, name, MappingProxyType(dict(getattr(self, name))))
        for name in ("effects", "load"):
            tables = {key: MappingProxyType(dict(values)) for key, values in getattr(self, name).items()}
            object.__setattr__(self, name, MappingProxyType(tables))
        if self.own_effects:
            where = self.source or "model"
            check_own_effects(self.own_effects, self.drive, where=f"{where}, [own_effects]")
            own = tuple(e if e.drive == self.drive else replace(e, drive=self.drive) for e in self.own_effects)
            object.__setattr__(self, "own_effects", own)
        self._check()

    def _check(self) -> None:
        """A name that nobody knows would be left out of the simulation without a word, a value taken as it is."""
        where = self.source or "model"
        motor, doubt = f"{where}, [motor]", f"{where}, [uncertainty]"
        table = self.effect_table if self.effects else {}
        places = {name: f"{where}, [effects.{name}]" for name in self.effects}
        _require(self.parameters, "parameter", [p.name for p in self.nominal_parameters], where=motor)
        _require(self.effects, "effect", table, where=f"{where}, [effects]")
        for name, values in self.effects.items():
            _require(values, "parameter", [p.name for p in table[name].every], where=places[name])
        known = [*(p.name for p in self.nominal_parameters), *self.effect_values]
        _require(self.uncertainty, "parameter", known, where=doubt)
        _require(self.load, "load", LOADS, where=f"{where}, [load]")

        check_numbers(self.parameters, where=motor, largest=LARGEST_COEFFICIENT if self.drive.coefficients else LARGEST)
        check_nominal(self.parameters, self.nominal_parameters, linear=self.linear, where=motor)
        for name in (*self.effects, *(own.name for own in self.own_effects)):
            check_site(self.effect_table[name], self.drive, where=places.get(name, f"{where}, [own_effects.{name}]"))
        for name, values in self.effects.items():
            check_numbers(values, where=places[name])
            check_effect(table[name], values, where=places[name])
        in_rad = {name: 1.0 if p.cyclic else value for name, (p, value) in self.effect_values.items()}
        check_uncertainty(self.uncertainty, {**self.parameters, **in_rad}, where=doubt)
        for name, values in self.load.items():
            check_numbers(values, where=f"{where}, [load.{name}]")
            check_nominal(values, LOADS[name], linear=False, where=f"{where}, [load.{name}]")
        check_constants(self.own_effects, self.effects, where=where)

    def __repr__(self) -> str:
        with_what = f" with {', '.join(self.effects)}" if self.effects else ""
        source = f", from {self.source}" if self.source else ""
        return f"<Model {self.kind}: {len(self.parameters)} parameters{with_what}{source}>"

    def _repr_html_(self) -> str:
        return f"<code>{escape(repr(self))}</code>"

    def __reduce__(self) -> tuple[Callable[[dict[str, Any]], Model], tuple[dict[str, Any]]]:
        """For pickle and copy, which know nothing of read-only mappings."""
        return _model_of, ({f.name: _plain(getattr(self, f.name)) for f in fields(self)},)

    @cached_property
    def effect_table(self) -> Mapping[str, Effect]:
        """Every effect that this model knows by name: those that come with rwn, then its own."""
        return with_own(vocabulary.table(), self.own_effects)

    @property
    def effect_values(self) -> Mapping[str, tuple[Parameter, float]]:
        """Each parameter of the model's effects that may be uncertain, with its value (SI), as "effect.parameter"."""
        return {
            f"{name}.{p.name}": (p, values[p.name])
            for name, values in self.effects.items()
            for p in self.effect_table[name].every
            if p.name in values and not p.fixed
        }

    @property
    def drive(self) -> Drive:
        """The kind's entry in the table of drives."""
        drive = drives.KINDS[self.kind]
        return drive.on_a_line if self.linear and drive.on_a_line else drive

    @property
    def nominal_parameters(self) -> tuple[NominalParameter, ...]:
        """The nominal parameters that this model can have."""
        return self.drive.nominal_parameters(self.order)

    @cached_property
    def motor(self) -> Mapping[str, float]:
        """Values of the parameter vector that belong to the drive itself: nominal parameters and known loads."""
        known = vocabulary.motor_parameters()
        motor = {n: v for n, v in self.parameters.items() if n in known or self.drive.coefficients}
        motor = self.drive.as_simulated(motor)
        for load in self.load.values():
            motor["pendulum_torque"] = load["mass"] * GRAVITY * load["length"]
        return MappingProxyType(motor)

    def table(self) -> pandas.DataFrame | list[dict[str, Any]]:
        """Every parameter, a row each; a list of dictionaries where pandas is not installed.

        Columns: parameter (of an effect: "effect.parameter"), value (SI), uncertainty (relative standard deviation; 0:
        exact), unit.
        """
        values = {**self.parameters, **{name: value for name, (_, value) in self.effect_values.items()}}
        rows = [(name, value, self.uncertainty.get(name, 0.0), self.unit(name)) for name, value in values.items()]
        made = [dict(zip(COLUMNS, row, strict=True)) for row in rows]
        found: pandas.DataFrame | list[dict[str, Any]] = table_of_rows(made, COLUMNS)
        return found

    @property
    def vector(self) -> NDArray[np.float64]:
        """The parameter vector (n_parameters,) of the model as it is, SI, as the core takes it."""
        return vocabulary.parameter_vector(self.motor, self.effects, self.effect_table)

    def unit(self, parameter: str) -> str:
        """SI unit of a nominal parameter, or of one of an effect as "effect.parameter"."""
        if parameter in self.effect_values:
            return self.drive.unit_of(self.effect_table[parameter.split(".")[0]], self.effect_values[parameter][0].unit)
        entry = next(p for p in self.nominal_parameters if p.name == parameter)
        return (entry.linear_unit if self.linear else entry.unit) or entry.unit


def _model_of(values: dict[str, Any]) -> Model:
    return Model(**values)


def _plain(value: Any) -> Any:
    return {key: _plain(inner) for key, inner in value.items()} if isinstance(value, Mapping) else value


def _require(names: Iterable[str], kind: str, known: Iterable[str], *, where: str) -> None:
    known = list(known)
    for name in names:
        if name not in known:
            raise unrecognised(kind, name, known, where=where)
