"""Effects that a user defines in the model file or in Python; see docs/own_effects.md."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from rwn import _core
from rwn.errors import InputError, unrecognised
from rwn.model import formula as expression
from rwn.model.drives.dc import DC
from rwn.model.drives.drive import Drive
from rwn.model.formula import Expression, Instruction
from rwn.model.vocabulary import Effect, Parameter, Scale, motor_index, table

# term: (site, SI unit on a shaft, on a linear axis, what the formula is); signs as in the motor equations.
TERMS: dict[str, tuple[str, str, str, str]] = {
    "torque": ("torque", "N m", "N", "torque that drives positive rotation"),
    "friction": ("torque", "N m", "N", "level of a dry friction that opposes motion and holds at standstill"),
    "load": ("load", "N m", "N", "torque of the load that drives positive rotation"),
    "drop": ("voltage", "V", "V", "voltage lost in the winding circuit"),
    "resistance": ("voltage", "1", "1", "factor of the resistance"),
    "flux": ("flux", "1", "1", "factor of both motor constants"),
    "inductance": ("flux", "1", "1", "factor of the inductance"),
    "input": ("actuator", "", "", "what acts in place of the commanded input"),
    "current": ("sensor", "A", "A", "current as it is recorded"),
    "speed": ("sensor", "rad/s", "m/s", "speed as it is recorded"),
    "position": ("sensor", "rad", "m", "position as it is recorded"),
}

# What a formula may use beside parameters: name -> (unit on a shaft, on a linear axis).
VARIABLES: dict[str, tuple[str, str]] = {
    "time": ("s", "s"),
    "input": ("", ""),  # that of the drive's input
    "current": ("A", "A"),
    "speed": ("rad/s", "m/s"),
    "position": ("rad", "m"),
    "direction": ("1", "1"),
    "drive_torque": ("N m", "N"),
}

TURN = 6.28  # rad: bounds of a phase that are written with three digits are a turn apart
MOST_SCANNED = 2  # most parameters that are scanned together; two make nine starts


@dataclass(frozen=True, kw_only=True)
class OwnParameter:
    """A parameter in SI, fitted from `start` within bounds; with equal bounds a constant that carries a unit.

    `strength`: at zero the effect is absent. `phase`: an angle, values a turn apart are one; its bounds are no limits.
    """

    name: str
    unit: str
    lower: float
    upper: float
    start: float
    meaning: str = ""
    strength: bool = False
    phase: bool = False

    @property
    def fixed(self) -> bool:
        """Whether it is a constant."""
        return self.lower == self.upper


@dataclass(frozen=True, kw_only=True)
class OwnEffect:
    """A user's effect: `equation` is the `term` of the motor's equations that it changes (a key of TERMS).

    Raises InputError when a name, bound, formula or unit is wrong.
    """

    name: str
    term: str
    equation: str
    parameters: tuple[OwnParameter, ...]
    drive: Drive = DC
    meaning: str = ""
    source: str = ""

    def __post_init__(self) -> None:
        where = f"own effect '{self.name}'"
        if not re.fullmatch(r"[a-z][a-z0-9]*(-[a-z0-9]+)*", self.name):
            raise InputError(
                "the name is not usable", where=where, expected="small letters and hyphens", fix="rename it"
            )
        if self.term not in TERMS:
            raise unrecognised("term", self.term, TERMS, where=where)
        if len(self.parameters) > _core.max_own_parameters:
            raise InputError(
                f"{len(self.parameters)} parameters",
                where=where,
                expected=f"at most {_core.max_own_parameters}",
                fix="write those that are known into the formula",
            )
        for parameter in self.parameters:
            _check_parameter(parameter, where)
        if not any(p.strength for p in self.parameters):
            raise InputError(
                "no parameter is its strength",
                where=where,
                expected="one with strength = true, at whose zero the effect is absent",
                fix="mark the amplitude",
            )
        expression.check_units(self.formula, self._names, self._unit, where=f"{where}, equation")

    @property
    def site(self) -> str:
        """Where it attaches, as for the effects that come with rwn."""
        return TERMS[self.term][0]

    @cached_property
    def formula(self) -> Expression:
        """The equation, compiled."""
        return expression.parse(self.equation, self._names, where=f"own effect '{self.name}', equation")

    @cached_property
    def core(self) -> _core.OwnEffect:
        """What the core simulates."""
        places = {p.name: ("parameter", k) for k, p in enumerate(self.parameters)}
        variables = {name: ("variable", k) for k, name in enumerate(VARIABLES)}
        nominal = {p.name: ("nominal", motor_index(p.name)) for p in self.drive.parameters}
        known = nominal | variables | places  # a parameter's own name comes first
        constants = {p.name: p.start for p in self.parameters if p.fixed}
        steps = [_step(s, known, constants) for s in self.formula.program]
        return _core.OwnEffect(self.term, steps, len(self.parameters))

    @property
    def _names(self) -> dict[str, str]:
        """Every name that the equation may use, with its SI unit; a parameter's own name comes first."""
        linear = self.drive.linear
        known = {name: unit[linear] or self.drive.input_unit for name, unit in VARIABLES.items()}
        nominal = {p.name: (p.linear_unit if linear else "") or p.unit for p in self.drive.parameters}
        return known | nominal | {p.name: p.unit for p in self.parameters}

    @property
    def _unit(self) -> str:
        return TERMS[self.term][1 + self.drive.linear] or self.drive.input_unit


def _step(
    step: Instruction, known: Mapping[str, tuple[str, int]], constants: Mapping[str, float]
) -> tuple[str, float, int]:
    """A step as the core takes it: operation, number, place."""
    if step.name in constants:
        return "number", constants[step.name], 0
    if step.operation == "name":
        operation, place = known[step.name]
        return operation, 0.0, place
    return step.operation, step.number, 0


def _check_parameter(p: OwnParameter, where: str) -> None:
    if not p.name.isidentifier() or p.name in VARIABLES or p.name in expression.FUNCTIONS:
        raise InputError(
            f"a parameter cannot be called '{p.name}'",
            where=where,
            expected="a name of its own",
            fix="rename it",
        )
    if (
        not all(map(math.isfinite, (p.lower, p.start, p.upper)))
        or not p.lower <= p.start <= p.upper
    ):
        raise InputError(
            f"{p.name} starts at {p.start:g} between {p.lower:g} and {p.upper:g}",
            where=where,
            expected="finite lower <= start <= upper",
            fix="correct the bounds",
        )
    if p.phase:
        _check_phase(p, where)


def _check_phase(p: OwnParameter, where: str) -> None:
    wrong = (
        f"its unit is {p.unit}" if p.unit not in ("rad", "1")
        else "it is a strength too" if p.strength
        else f"{p.lower:g} to {p.upper:g} is no turn" if p.upper - p.lower < TURN else ""
    )  # fmt: skip
    if wrong:
        raise InputError(
            f"{p.name} is a phase, but {wrong}", where=where,
            expected="a parameter in rad that is no strength, with bounds a turn apart",
            fix="write unit = 'rad', lower = -3.1416, upper = 3.1416, or remove phase = true",
        )  # fmt: skip


def check_own_effects(own: Sequence[OwnEffect], drive: Drive, *, where: str) -> None:
    """Whether a model of this kind of drive can have these effects together. Raises InputError."""
    if own and drive.coefficients:
        raise InputError(
            "a transfer function has no equations to add effects to",
            where=where,
            expected="kind dc or axis",
            fix="remove them, or model the drive as dc or axis",
        )
    if len(own) > _core.max_own_effects:
        raise InputError(
            f"{len(own)} own effects", where=where, expected=f"at most {_core.max_own_effects}", fix="remove some"
        )
    names = [effect.name for effect in own]
    for k, name in enumerate(names):
        if name in table() or name in names[:k]:
            raise InputError(
                f"'{name}' is an effect that is there already",
                where=where,
                expected="a name of its own",
                fix=f"rename it, or use [effects.{name}]",
            )


def check_constants(own: Sequence[OwnEffect], given: Mapping[str, Mapping[str, float]], *, where: str) -> None:
    """Whether a model that has these effects leaves their constants as they are. Raises InputError."""
    for effect in own:
        values = given.get(effect.name, {})
        for p in effect.parameters:
            value = values.get(p.name, p.start)
            if p.fixed and not math.isclose(value, p.start, rel_tol=1e-6):
                raise InputError(
                    f"{p.name} is {value:g} {p.unit}",
                    where=f"{where}, [effects.{effect.name}]",
                    expected=f"{p.start:g} {p.unit}, the constant that [own_effects.{effect.name}] makes it",
                    fix=f"remove it here, or change lower, upper and start of parameters.{p.name} there",
                )


def with_own(known: Mapping[str, Effect], own: Sequence[OwnEffect]) -> Mapping[str, Effect]:
    """A table of effects with a user's behind those that are `known`."""
    rows = {}
    for slot, effect in enumerate(own):
        rows[effect.name] = Effect(
            name=effect.name,
            site=effect.site,
            mismatch=_EQUATIONS[effect.site],
            equation=f"{effect.term} = {effect.equation}",
            meaning=effect.meaning,
            source=effect.source,
            parameters=tuple(_as_parameter(p, effect.parameters) for p in effect.parameters),
            index=len(known) + slot,
            first=_core.first_own_parameter() + slot * _core.max_own_parameters,
            turns="position" in effect.formula.names,
            own=True,
        )
    return {**known, **rows}


_EQUATIONS = {effect.site: effect.mismatch for effect in table().values()}


def _as_parameter(p: OwnParameter, among: Sequence[OwnParameter]) -> Parameter:
    return Parameter(
        name=p.name, unit=p.unit, meaning=p.meaning, lower=p.lower, upper=p.upper, start=p.start, scale=Scale(),
        scan=_scan(p, among), strength=p.strength, fixed=p.fixed, cyclic=p.phase, order=False, idealised=False,
        natural=False, replaces=None,
    )  # fmt: skip


def _scan(p: OwnParameter, among: Sequence[OwnParameter]) -> tuple[float, ...]:
    """First guesses of a parameter that bends the formula: where it starts, and half way to either bound.

    A phase has four a turn.
    """
    if p.phase:
        return tuple(p.start + quarter * math.pi / 2.0 for quarter in range(4))
    bending = [q for q in among if not (q.strength or q.fixed or q.phase)]
    if p not in bending or len(bending) > MOST_SCANNED:
        return ()
    if p.lower > 0.0:
        return p.start, (p.lower * p.start) ** 0.5, (p.start * p.upper) ** 0.5
    return p.start, (p.lower + p.start) / 2.0, (p.start + p.upper) / 2.0
