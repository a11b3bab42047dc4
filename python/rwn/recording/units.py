"""Units at the edges: everything inside is SI (radians included)."""

from __future__ import annotations

import functools
import re
import threading
from typing import Any

from rwn.errors import InputError, closest, plain

# What people write and pint reads otherwise ("Nm" is its number metre, "Hz" its radian per second, "amps" an
# attometre per second).
_SPELLINGS = (
    (re.compile("²"), "^2"),  # first: it counts as a letter
    (re.compile(r"\b([kmcuµ]?)N(m|cm|mm)(s?)\b"), r"\1N \2 \3"),
    (re.compile(r"\b([kmuµ]?)Vs\b"), r"\1V s"),
    (re.compile(r"\b(k?g)(m|cm|mm)\b"), r"\1 \2"),
    (re.compile(r"\bRPM\b|\b(?:r|tr|U|Umdr\.?|1)/min\b|\bmin(?:\^?-1|⁻¹)(?!\w)"), "rpm"),
    (re.compile(r"\brevs?\b|\brotations?\b"), "turn"),
    (re.compile(r"\b[Aa]mps?\b"), "A"),
    (re.compile(r"Ohms?\b"), "ohm"),
    (re.compile(r"[·⋅]"), "*"),
)
_COMMON = (
    *("V", "mV", "A", "mA", "s", "ms", "us", "rad", "deg", "turn", "rad/s", "deg/s", "rpm", "turn/s"),
    *("m", "mm", "m/s", "mm/s", "N", "kN", "N*m", "mN*m", "ohm", "H", "mH", "kg", "kg*m^2", "g*cm^2"),
    *("N*m/A", "V*s/rad", "N*m*s/rad", "N*s/m"),
)


_LONGEST = 80  # characters of a unit
_NUMBER = r"(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_SKIPPED = re.compile(r"[!?$~§&@\\|<>=]")
_POWER = re.compile(r"\^|\*\*")
_SMALL_POWER = re.compile(r"(?<![\d. )])[ )]*(?:\^|\*\*) *\(? *[-+]? *\d(?:\.\d*)?(?![\d.])")


def _believable(text: str) -> bool:
    """Whether a text may be a unit: of no number and of no power is a power taken, and none beyond 9.

    pint works them out in whole numbers, and a tower of them lasts for ever; signs that it does not know it skips.
    """
    plain_text = len(text) <= _LONGEST and not _SKIPPED.search(text)
    return plain_text and len(_POWER.findall(text)) == len(_SMALL_POWER.findall(text))


def _registry() -> Any:
    with _ONE:  # quantities of two registries do not go together, and threads ask for it at once
        return _made()


@functools.cache
def _made() -> Any:
    import pint

    registry = pint.UnitRegistry()
    registry.formatter.default_sort_func = lambda factors, _: list(factors)  # as written: m N reads as millinewton
    return registry


_ONE = threading.Lock()


def _parse(text: str, *, where: object) -> Any:
    spelled = text
    for pattern, replacement in _SPELLINGS:
        spelled = pattern.sub(replacement, spelled)
    try:
        if not _believable(spelled):
            raise ValueError(spelled)
        return _known(spelled)
    except Exception as error:  # pint raises its own, tokenize's and Python's errors for what is no unit
        meant = closest(text, _COMMON)
        raise InputError(
            f"unknown unit '{plain(text, longest=_LONGEST)}'",
            where=where,
            expected="a unit such as V, mA, rad/s, rpm, deg, N m, kg m^2",
            fix=f"did you mean '{meant}'?" if meant else "write the unit in SI or with an SI prefix",
        ) from error


def _known(spelled: str) -> Any:
    """The unit; a word that only its capital makes unknown is taken without: `Volts`, as LabVIEW writes it.

    That takes no mega for milli: what is a unit after m is one after M too, and so not unknown.
    """
    try:
        return _registry().parse_units(spelled)
    except Exception:  # of the many kinds of _parse
        return _registry().parse_units(re.sub(r"\b[A-Z][a-z]{2,}\b", lambda word: word[0].lower(), spelled))


def _angle_power(unit: Any) -> float:
    base = _registry().Quantity(1.0, unit).to_base_units().units
    return float(dict(base._units).get("radian", 0))


def _is_share(unit: Any) -> bool:
    """Whether it is a percentage or a count, which has the dimension of an angle and is none."""
    return bool(unit.dimensionless) and not _angle_power(unit)


def _other_dimension(unit: str, si_unit: str, given: Any, wanted: Any) -> str:
    if _is_share(given):
        return f'say what it is worth, with its unit, by a scale: scale = "0.24 {si_unit}/{unit}", for instance'
    if (1 / _registry().Quantity(1.0, given)).dimensionality == wanted.dimensionality:
        turned = "/".join(reversed(unit.split("/")))
        return f"this is a unit of the inverse (a speed constant, for instance): write 1 over the number, in {turned}"
    return f"write the unit that the numbers have, for instance {si_unit} ([{si_unit}] in a header)"


def factor(unit: str, si_unit: str, *, where: object, strict_angle: bool = True) -> float:
    """What a number in `unit` is multiplied by to be in `si_unit`.

    Raises InputError when `unit` is unknown, has another dimension, or (strict_angle) leaves open which
    angle it counts: 1/s and Hz are no speeds of a shaft; rad/s, rpm and turn/s are.
    """
    given, wanted = _parse(unit, where=where), _parse(si_unit, where=where)
    quantity = _registry().Quantity(1.0, given)
    expected = f"a unit like {si_unit}"
    if given.dimensionality != wanted.dimensionality:
        raise InputError(
            f"unit '{unit}' has the wrong dimension",
            where=where,
            expected=expected,
            fix=_other_dimension(unit, si_unit, given, wanted),
        )
    power, wanted_power = _angle_power(given), _angle_power(wanted)
    if power != wanted_power and (strict_angle or power != 0 or "hertz" in str(given)):
        raise InputError(
            f"unit '{unit}' does not say which angle it counts",
            where=where,
            expected=expected,
            fix="write rad, deg or turn (rad/s, deg/s, rpm, turn/s)",
        )
    return float(quantity.to_base_units().magnitude)


def split(text: str, *, where: object, example: str = "0.4 N/V") -> tuple[float, str]:
    """A number, or a fraction of two, and the unit after it ("" without one). Raises InputError where there is none."""
    match = re.fullmatch(rf"\s*([-+]?{_NUMBER})(?:\s*/\s*({_NUMBER})(?=\s|$))?\s*(.*?)\s*", text)
    comma = re.match(r"\s*[-+]?\d+,\d", text)
    if match is None or comma or (match[2] and float(match[2]) == 0.0):
        raise InputError(
            f"'{plain(text, longest=40)}' is not a number with a unit",
            where=where,
            expected=f'text like "{example}"',
            fix="write a point for the decimal comma" if comma else "write the number first, then its unit",
        )
    return float(match[1]) / float(match[2] or 1.0), match[3]


def quantity(text: str, si_unit: str, *, where: object) -> float:
    """A number with a unit, such as "0.4 mH", in SI. Raises InputError, also where the unit is missing."""
    number, unit = split(text, where=where, example=f"0.4 {si_unit}")
    if not unit and si_unit not in ("", "1", "dimensionless"):
        raise InputError(
            f"'{plain(text, longest=40)}' is text without a unit",
            where=where,
            expected=f"a number in {si_unit}, or text with a unit",
            fix=f'write {number:g}, without quotes, or "{number:g} {si_unit}"',
        )
    return number * factor(unit, si_unit, where=where, strict_angle=False) if unit else number


def product(unit: str, scale_unit: str) -> str:
    """The unit of a number in `unit` multiplied by a scale in `scale_unit`."""
    return f"({unit})*({scale_unit})" if scale_unit else unit


def has_dimension(unit: str, si_unit: str, *, where: object) -> bool:
    """Whether `unit` measures the same kind of quantity as `si_unit`. Raises InputError for a unit that is none."""
    given, wanted = _parse(unit, where=where), _parse(si_unit, where=where)
    return bool(given.dimensionality == wanted.dimensionality) and not (_is_share(given) and _angle_power(wanted))


def same(one: str, other: str, *, where: object) -> bool:
    """Whether numbers in both units mean the same. Raises InputError where one of them is unknown."""
    first, second = (_registry().Quantity(1.0, _parse(unit, where=where)).to_base_units() for unit in (one, other))
    return bool(first.units == second.units and abs(first.magnitude / second.magnitude - 1.0) < 1e-9)


def is_unit(text: str) -> bool:
    """Whether `text` can be read as a unit."""
    try:
        _parse(text, where="")
    except InputError:
        return False
    return True


def sample(unit: str, value: float) -> Any:
    """`value` of `unit` as a quantity that refuses sums of unlike kinds; for checking formulas.

    Raises InputError for a unit that is none.
    """
    return _registry().Quantity(
        value, _parse(unit if unit not in ("", "1") else "dimensionless", where="units")
    )


def same_dimension(result: Any, unit: str) -> None:
    """Raises pint's DimensionalityError unless `result` (a number or a `sample`) is of the kind of `unit`."""
    wanted = _parse(unit if unit not in ("", "1") else "dimensionless", where="units")
    _registry().Quantity(result).to(wanted)


def clash(error: Exception) -> str:
    """Which units do not go together, of what pint says in words of its own."""
    import pint  # late: the command line starts without it

    if not isinstance(error, pint.DimensionalityError):
        return str(error)
    pair = (f"{_registry().Unit(unit):~C}" for unit in (error.units1, error.units2))
    one, other = (unit.replace("**", "^").replace("*", " ") or "a plain number" for unit in pair)
    return f"{one} is not {other}"


def linear_unit(unit: str) -> str:
    """The unit of a linear axis in place of that of a shaft: N for N m, kg for kg m^2, m/s for rad/s."""
    for rotary, linear in (("N m", "N"), ("kg m^2", "kg"), ("rad/s", "m/s"), ("/rad", "/m")):
        unit = unit.replace(rotary, linear)
    return unit
