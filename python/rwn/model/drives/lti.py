"""A linear transfer function from voltage to speed, of any order."""

from __future__ import annotations

import math
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from rwn.errors import InputError, plain, unrecognised
from rwn.model.drives.drive import USUAL_VOLTAGE, Drive, NominalParameter

MOST_ORDER = 20


@dataclass(frozen=True, kw_only=True)
class TransferFunction(Drive):
    """Parameters b0, b1, .. and a0, .. are the coefficients of s^0, s^1, .., monic in the denominator."""

    def nominal_parameters(self, order: int) -> tuple[NominalParameter, ...]:
        """The coefficients of a transfer function of `order`."""
        return (
            *(_coefficient(f"b{k}", order - k, "rad/(V s)", f"numerator, s^{k}") for k in range(order)),
            *(_coefficient(f"a{k}", order - k, "", f"denominator, s^{k}") for k in range(order)),
        )

    def usual_input(self, motor: Mapping[str, float]) -> float:  # noqa: ARG002
        """A voltage [V], to a factor of some hundred."""
        return USUAL_VOLTAGE

    def read(self, motor: Mapping[str, Any], *, where: str) -> tuple[dict[str, Any], int]:
        """The coefficients from numerator and denominator, highest power first; none where `order` stands alone.

        Raises InputError where one is missing, no number, or not proper.
        """
        order = motor.get("order", 0)
        if "order" not in motor and isinstance(motor.get("denominator"), list):
            order = len(motor["denominator"]) - 1
        if isinstance(order, bool) or not isinstance(order, int) or not 1 <= order <= MOST_ORDER:
            raise InputError(
                f"order is {order!r}",
                where=where,
                expected=f"a whole number from 1 to {MOST_ORDER}",
                fix="write for instance order = 3",
            )
        return _coefficients({key: value for key, value in motor.items() if key != "order"}, order, where), order

    def lines(self, parameters: Mapping[str, float], order: int) -> list[str] | None:
        """The order, and the coefficients where they are given."""
        lines = [f"order = {order}"]
        if not parameters:
            return lines
        b = [parameters[f"b{k}"] for k in reversed(range(order)) if f"b{k}" in parameters]
        a = [1.0, *(parameters[f"a{k}"] for k in reversed(range(order)))]
        return [*lines, f"numerator = {b!r}", f"denominator = {a!r}"]


LTI = TransferFunction(
    kind="lti", input="voltage", outputs=("speed",), parameters=(), coefficients=True, shaft=False,
)  # fmt: skip


def _coefficient(name: str, power: int, unit: str, meaning: str) -> NominalParameter:
    per = f"1/s^{power}"
    return NominalParameter(
        name=name, unit=f"{unit}*{per}" if unit else per, meaning=meaning, required=False, signed=True
    )


def _coefficients(given: Mapping[str, Any], order: int, where: str) -> dict[str, Any]:
    """numerator and denominator (highest power first) as b_k and a_k with a leading denominator of 1."""
    for key in given:
        if key not in ("numerator", "denominator"):
            raise unrecognised("key", key, ("kind", "order", "numerator", "denominator"), where=where)
    if not given:
        return {}
    lists = {key: given.get(key, []) for key in ("numerator", "denominator")}
    for key, values in lists.items():
        if not isinstance(values, list) or not all(map(_is_finite, values)):
            raise InputError(
                f"{key} is {plain(repr(values), longest=60)}",
                where=where,
                expected="a list of numbers, highest power first",
                fix=f"write for instance {key} = [1.0, 20.0]",
            )
    numerator, denominator = lists["numerator"], lists["denominator"]
    if len(denominator) != order + 1 or denominator[0] == 0 or not 1 <= len(numerator) <= order:
        raise InputError(
            f"numerator has {len(numerator)} and denominator {len(denominator)} coefficients",
            where=where,
            expected=f"1 to {order} and {order + 1} for order {order}, the first not zero",
            fix="correct order or the coefficients",
        )
    lead = float(denominator[0])
    b = {f"b{k}": float(x) / lead for k, x in enumerate(reversed(numerator))}
    found = {**b, **{f"a{k}": float(x) / lead for k, x in enumerate(reversed(denominator[1:]))}}
    if not all(map(math.isfinite, found.values())):
        raise InputError(
            f"the denominator begins with {lead:g}, against which the others are too large",
            where=where,
            expected="coefficients whose ratios are numbers",
            fix="correct the coefficients",
        )
    return found


def _is_finite(x: Any) -> bool:
    """Whether it is a number that a float holds; TOML writes integers of any length."""
    return type(x) in (int, float) and bool(abs(x) <= sys.float_info.max)  # NaN is not
