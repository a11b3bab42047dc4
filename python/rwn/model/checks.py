"""Are the values of a model such as a drive can have? The same for a model file and for one made in Python."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any

from rwn.errors import InputError
from rwn.model.drives.drive import Drive, NominalParameter
from rwn.model.vocabulary import Effect, Parameter
from rwn.recording.units import factor

LARGEST = 1e15  # of any number in SI: no drive comes near
LARGEST_COEFFICIENT = 1e200  # of a transfer function: powers of frequencies
ROUNDED = 1e-6  # relative: a fitted value at its bound, as it is written and read again


def check_numbers(values: Mapping[str, Any], *, where: str, largest: float = LARGEST) -> None:
    """Every value is a real number of believable size. Raises InputError."""
    for name, value in values.items():
        try:
            number = float(value)
        except (TypeError, ValueError, OverflowError):
            number = math.nan if not isinstance(value, int) else math.inf
        if isinstance(value, bool | str | bytes) or not abs(number) <= largest:
            raise InputError(
                f"the value is {value!r}",
                where=f"{where} {name}",
                expected=f"a finite number in SI, at most {largest:g}",
                fix="write the number; where it is unknown, a guess with a large uncertainty",
            )


def check_nominal(values: Mapping[str, float], known: Iterable[NominalParameter], *, linear: bool, where: str) -> None:
    """Required ones are there, none has a sign that it cannot have. Raises InputError."""
    for entry in known:
        unit = (entry.linear_unit if linear else entry.unit) or entry.unit
        if entry.name not in values:
            if entry.required:
                raise InputError(
                    f"there is no {entry.name} ({entry.meaning})",
                    where=where,
                    expected=f"a number in {unit}",
                    fix="add it from the data sheet, and its doubt to [uncertainty]",
                )
            continue
        value = values[entry.name]
        if (value < 0 and not entry.signed) or (entry.positive and value == 0):
            raise InputError(
                f"{entry.name} is {value:g} {unit}",
                where=where,
                expected="a positive number" if entry.positive else "a number that is not negative",
                fix="correct the value or its unit",
            )


FARTHEST = 10.0  # times each other that two parameters may be which are one number but for losses


def check_one_numbers(drive: Drive, parameters: Mapping[str, float], *, where: str) -> None:
    """No two parameters that are one number in SI are far apart: one lacks its unit. Raises InputError."""
    units = {entry.name: entry.unit for entry in drive.parameters}
    for pair in drive.one_numbers:
        small, large = sorted((pair.name, pair.like), key=lambda name: abs(parameters.get(name, 0.0)))
        if abs(parameters.get(large, 0.0)) > FARTHEST * abs(parameters.get(small, math.inf)):
            ratio = abs(parameters[large] / parameters[small]) if parameters[small] else math.inf
            of_data_sheet = 1.0 / factor(pair.data_sheet_unit, units[pair.like], where=where)
            meant = (pair.like, parameters[pair.like], pair.data_sheet_unit)
            if ratio > math.sqrt(1e3 * of_data_sheet):  # nearer to a thousand than to what that unit makes
                meant = (large, parameters[large], f"m{units[large]}")
            raise InputError(
                f"{large} is {parameters[large]:g} {units[large]} and {small} {parameters[small]:g} {units[small]}, "
                f"{ratio:.3g} times apart",
                where=where,
                expected="about the same number: in SI they are one of a machine",
                fix=f'write the unit of the data sheet with the value, as in {meant[0]} = "{meant[1]:g} {meant[2]}", '
                "or leave one of them out",
            )


LOOSEST = 3.0  # relative deviation; at 95 % it leaves a factor of 400 either way, which says as much as inf


def check_uncertainty(values: Mapping[str, float], parameters: Mapping[str, float], *, where: str) -> None:
    """Each is a relative deviation of a value that is not 0, at most LOOSEST, or infinite. Raises InputError.

    Above that it is a percentage without its sign, or nothing is known, and a number would feign that something is.
    """
    check_numbers({name: value for name, value in values.items() if value != math.inf}, where=where)
    for name, value in values.items():
        if value < 0 or LOOSEST < value < math.inf:
            in_percent = f'write {value / 100:g} or "{value:g} %", or inf' if value <= 100 else "write inf"
            raise InputError(
                f"{name} is {value:g}" + (f", that is {100 * value:g} %" if value > 0 else ""),
                where=where,
                expected=f"a relative standard deviation of at most {LOOSEST:g}, 0.1 = 10 %, or inf",
                fix="write it without a sign" if value < 0 else f"{in_percent} where nothing is known",
            )
        if 0 < value < math.inf and parameters.get(name, 0.0) == 0:
            raise InputError(
                f"{name} is relative to a nominal value of 0",
                where=where,
                expected="a nominal value that is not 0",
                fix="give a guess of the value, or write inf",
            )


def check_site(effect: Effect, drive: Drive, *, where: str) -> None:
    """The drive's equations have the term that an effect changes. Raises InputError."""
    if effect.site not in drive.sites:
        raise InputError(
            f"{effect.name} acts on the {effect.site}, which a drive of kind {drive.kind} has no equation for",
            where=where,
            expected=f"effects on {', '.join(sorted(drive.sites))}",
            fix="take it out, or describe the whole drive by another kind",
        )


def check_effect(effect: Effect, values: Mapping[str, float], *, where: str) -> None:
    """Every parameter is there and within its bounds as far as they are known without a recording. Raises InputError.

    Bounds that are relative to what a recording shows (torque, speed, ..) say the sign alone; those of a user's own
    effect are where a fit searches.
    """
    begun = {p.line for p in effect.further if p.name in values}
    for p in (*effect.parameters, *(p for p in effect.further if p.line in begun)):
        if p.name not in values:
            if not p.fixed:
                raise InputError(
                    f"there is no {p.name}", where=where, expected=f"a number in {p.unit}", fix=f"add {p.name} = ..."
                )
            continue
        lower, upper = bounds_beforehand(p)
        value = values[p.name]
        slack = ROUNDED * max(abs(bound) for bound in (lower, upper, value) if math.isfinite(bound))
        if not (p.cyclic or effect.own) and not lower - slack <= value <= upper + slack:
            to = f"{lower:g} to {upper:g}" if math.isfinite(upper) else f"at least {lower:g}"
            raise InputError(
                f"{p.name} is {value:g}" + (f" {p.unit}" if p.unit not in ("", "1") else ""),
                where=where,
                expected=f"{to} ({p.meaning})",
                fix=f"correct the value or its unit; see rwn effects {effect.name}",
            )
    ends = [values[p.name] for p in effect.instants if p.name in values]
    if len(ends) == 2 and ends[0] >= ends[1]:
        first, last = effect.instants
        raise InputError(
            f"{last.name} is {ends[1]:g} {last.unit}, {first.name} {ends[0]:g}: it never acts",
            where=where,
            expected=f"{first.name} before {last.name}",
            fix=f"exchange the two, or remove [effects.{effect.name}]",
        )


def bounds_beforehand(p: Parameter) -> tuple[float, float]:
    """Bounds (SI) of a parameter as far as they are known without a recording: the sign alone of what is relative."""
    if not p.scale.powers:
        return p.scale.factor * p.lower, p.scale.factor * p.upper
    return (0.0 if p.lower >= 0.0 else -math.inf), math.inf
