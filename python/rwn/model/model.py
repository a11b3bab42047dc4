"""A model of a drive: nominal parameters and how sure one is of them, effects, layout of recordings."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from types import MappingProxyType
from typing import Any, Protocol, cast

from rwn.errors import InputError, unknown
from rwn.model import drives
from rwn.model import vocabulary as effects
from rwn.model.drives import Drive, Nominal
from rwn.model.own_effects import OwnEffect, check_constants, check_own_effects, with_own
from rwn.model.vocabulary import Effect
from rwn.recording.columns import Layout


class EffectParameter(Protocol):
    """What is read of one parameter of an effect."""

    @property
    def name(self) -> str: ...
    @property
    def unit(self) -> str: ...
    @property
    def fixed(self) -> bool: ...


class EffectEntry(Protocol):
    """What is read of one effect of the table."""

    @property
    def parameters(self) -> tuple[Any, ...]: ...  # of EffectParameter


EffectTable = Mapping[str, EffectEntry]


@dataclass(frozen=True, kw_only=True)
class Model:
    """Kind of drive, nominal `parameters` (SI) and relative standard deviations `uncertainty` (not listed:
    exact), `effects` name -> parameter values (SI), known `load`s, `recording` layout.

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
        if self.kind not in drives.KINDS:
            raise unknown("kind", self.kind, drives.KINDS, where=self.source or "model")
        for name in ("parameters", "uncertainty"):
            object.__setattr__(self, name, MappingProxyType(dict(getattr(self, name))))
        for name in ("effects", "load"):
            tables = {key: MappingProxyType(dict(values)) for key, values in getattr(self, name).items()}
            object.__setattr__(self, name, MappingProxyType(tables))
        if self.own_effects:
            where = self.source or "model"
            check_own_effects(self.own_effects, self.kind, where=f"{where}, [own_effects]")
            check_constants(self.own_effects, self.effects, where=where)
            own = tuple(e if e.drive == self.drive else replace(e, drive=self.drive) for e in self.own_effects)
            object.__setattr__(self, "own_effects", own)
        self._check_names()

    def _check_names(self) -> None:
        """A name that nobody knows would be left out of the simulation without a word."""
        where = self.source or "model"
        _require(self.parameters, "parameter", [p.name for p in self.nominal], where=where)
        _require(self.uncertainty, "parameter", [p.name for p in self.nominal], where=f"{where}, uncertainty")
        if not self.effects:
            return
        table = self.effect_table
        _require(self.effects, "effect", table, where=f"{where}, effects")
        for name, values in self.effects.items():
            known = [p.name for p in table[name].parameters]
            _require(values, "parameter", known, where=f"{where}, effects.{name}")

    @cached_property
    def effect_table(self) -> Mapping[str, Effect]:
        """Every effect that this model knows by name: those that come with rwn, then its own."""
        return with_own(effects.table(), self.own_effects)

    @property
    def drive(self) -> Drive:
        """The kind's entry in the table of drives."""
        return drives.LINEAR_AXIS if self.kind == "axis" and self.linear else drives.KINDS[self.kind]

    @property
    def nominal(self) -> tuple[Nominal, ...]:
        """The nominal parameters that this model can have."""
        return self.drive.parameters or lti_parameters(self.order)

    def unit(self, parameter: str) -> str:
        """SI unit of a nominal parameter."""
        entry = next(p for p in self.nominal if p.name == parameter)
        return (entry.linear_unit if self.linear else entry.unit) or entry.unit


def _require(names: Iterable[str], kind: str, known: Iterable[str], *, where: str) -> None:
    known = list(known)
    for name in names:
        if name not in known:
            raise unknown(kind, name, known, where=where)


def lti_parameters(order: int) -> tuple[Nominal, ...]:
    """Coefficients of a transfer function of `order` from voltage to speed."""
    numerator = [
        Nominal(
            name=f"b{k}",
            unit=_coefficient_unit(order - k, "rad/(V s)"),
            meaning=f"numerator, s^{k}",
            required=False,
        )
        for k in range(order)
    ]
    denominator = [
        Nominal(
            name=f"a{k}", unit=_coefficient_unit(order - k, ""), meaning=f"denominator, s^{k}", required=False
        )
        for k in range(order)
    ]
    return (*numerator, *denominator)


def _coefficient_unit(power: int, unit: str) -> str:
    per = f"1/s^{power}"
    return f"{unit}*{per}" if unit else per


def effect_table() -> EffectTable:
    """The effects that rwn knows, from the core."""
    return cast(EffectTable, effects.table())


def read_model(path: str | Path, *, effects: EffectTable | None = None) -> Model:
    """Read a model file; see docs/models.md. `effects`: what may stand in [effects] (default: all known).

    Raises InputError: what, in which table and key, what was expected, how to fix it.
    """
    from rwn.model.toml_reader import parse_model

    return parse_model(_read_text(Path(path)), where=str(path), effects=effects)


def write_model(model: Model, path: str | Path) -> None:
    """Write a model file that `read_model` reads back as an equal model."""
    from rwn.model.toml_writer import format_model

    Path(path).write_text(format_model(model), encoding="utf-8")


def _read_text(path: Path) -> str:
    if path.is_dir():
        raise InputError(
            "this is a folder", where=path, expected="a model file (TOML)", fix="name the file in it"
        )
    try:
        if path.stat().st_size > 2**20:
            raise InputError(
                "the model file is larger than 1 MB",
                where=path,
                expected="a short TOML file",
                fix="was a recording given as --model?",
            )
        return path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(
            "this is not a text file",
            where=path,
            expected="a model file (TOML, UTF-8)",
            fix="give the model file, not a recording",
        ) from error
    except OSError as error:
        raise InputError(
            f"cannot read the file ({(error.strerror or str(error)).lower()})",
            where=path,
            expected="a readable model file",
            fix="check the path and its permissions",
        ) from error
