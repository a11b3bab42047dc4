"""Numbers, names and places as people read them: SI prefixes, uncertainty, symbols."""

from __future__ import annotations

import math
from collections.abc import Sequence

from rwn.decide.shaft_alone import ShaftAlone
from rwn.fit.intervals import Estimate
from rwn.mismatch_map.dependence import CLEAR, Law
from rwn.mismatch_map.regions import Region
from rwn.model.vocabulary import table
from rwn.name.not_tried import NotTried
from rwn.recording.signals import SIGNALS

EXCESS = 0.1  # share of the residual's energy beyond that of the samples, from which a region is worth naming
_PREFIXES = {-12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G"}
_PREFIXABLE = (
    "V",
    "A",
    "N",
    "H",
    "ohm",
    "s",
    "W",
    "J",
    "m",
)  # the first factor of a unit that takes a prefix
DECADE = 10.0
NAMED_AT_ONCE = 8  # effects in one sentence
_SYMBOLS = (("ohm", "Ω"), ("^2", "²"), ("^3", "³"))
_SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def prefix_for(magnitude: float, unit: str) -> tuple[float, str]:
    """What SI numbers of about `magnitude` are multiplied by for reading, and their unit then."""
    first = unit.split(" ")[0].split("/")[0]
    if first not in _PREFIXABLE or magnitude == 0 or not math.isfinite(magnitude):
        return 1.0, symbol(unit)
    size = math.log10(magnitude * 1.0000001)
    power = 3 * math.floor((size if size >= 0 else size + 1) / 3)  # 0.8 ohm stays, 0.08 ohm is 80 mohm
    power = min(max(power, -12), 9)
    power = min(power, 0) if first == "s" else power  # no kiloseconds
    return 10.0**-power, _PREFIXES[power] + symbol(unit)


def symbol(unit: str) -> str:
    """A unit with signs instead of words: ohm as Ω, ^2 as ²."""
    for word, sign in _SYMBOLS:
        unit = unit.replace(word, sign)
    return "" if unit in ("1", "dimensionless") else unit


def number(value: float, digits: int = 3) -> str:
    """`value` with `digits` significant digits, powers of ten where it is far from one."""
    if not math.isfinite(value):
        return "–"
    if value == 0:
        return "0"
    power = math.floor(math.log10(abs(value)))
    if -4 <= power < 6:
        return f"{value:.{max(digits - 1 - power, 0)}f}".replace("-", "−")
    text = f"{value / 10.0**power:.{digits - 1}f}×10{str(power).translate(_SUPERSCRIPT)}"
    return text.replace("-", "−")


def times_given(factor: float, *, declared: float = 0.0) -> str:
    """What became of a value of the data sheet, as a multiple of it.

    `declared`: its relative uncertainty. What is a power of ten within two such may have been given in another unit.
    """
    if factor <= 0.0:
        return "zero"
    power = round(math.log10(factor))
    unit = power != 0 and abs(math.log(factor / 10.0**power)) < 2.0 * declared
    return f"{number(factor, 2)} times what was given{', which may be in another unit' if unit else ''}"


def quantity(value: float, unit: str, digits: int = 3) -> str:
    """A value in SI as people read it: 0.0124 "A" as "12.4 mA"."""
    scale, shown = prefix_for(abs(value), unit)
    return f"{number(value * scale, digits)} {shown}".strip()


def estimate(value: Estimate) -> str:
    """A value with its 95 % interval: "20.4 ± 0.3 N", or "20.4 N [19.0, 25.1]" where that is lopsided.

    In words where it reaches over more than a decade to both sides.
    """
    if value.interval is None:
        return quantity(value.value, value.unit)
    low, high = value.interval
    below, above = value.value - low, high - value.value
    scale, shown = prefix_for(abs(value.value) or max(abs(low), abs(high)), value.unit)
    half = (high - low) / 2
    if not math.isfinite(half) or half <= 0:
        return quantity(value.value, value.unit)
    if 0.0 <= low < value.value / DECADE and high > DECADE * value.value:
        return f"{quantity(value.value, value.unit)}, not told to a factor of ten"
    middle, half_text, power = _rounded_together(value.value * scale, half * scale)
    if min(below, above) < 0 or max(below, above) > 2 * min(below, above):
        bounds = ", ".join(number(bound * scale) for bound in (low, high))
        return f"{number(value.value * scale)} {shown}".strip() + f" [{bounds}]"
    text = f"{middle} ± {half_text}"
    return (f"({text}){power} {shown}" if power else f"{text} {shown}").strip()


def _rounded_together(value: float, half: float) -> tuple[str, str, str]:
    """Both to the first or second digit of `half`; a common power of ten where the value is far from one."""
    top = math.floor(math.log10(max(abs(value), half)))
    shift = 0 if -3 <= top < 5 else top
    value, half = value / 10.0**shift, half / 10.0**shift
    top = math.floor(math.log10(half))
    decimals = max((1 if half < 2.95 * 10.0**top else 0) - top, 0)
    power = f"×10{str(shift).translate(_SUPERSCRIPT)}" if shift else ""
    return f"{value:.{decimals}f}".replace("-", "−"), f"{half:.{decimals}f}", power


def percent(share: float) -> str:
    """A share as a percentage with no more digits than it deserves."""
    value = 100 * share
    if not math.isfinite(value):
        return "–"
    if 99 <= abs(value) < 100:
        return f"{value:.1f} %" if abs(value) < 99.95 else ("−" if value < 0 else "") + "> 99.9 %"
    return f"{value:.0f} %" if abs(value) >= 10 or value == 0 else f"{value:.1f} %"


def likelihood(probability: float) -> str:
    """A probability as a percentage that never claims certainty."""
    if math.isnan(probability):
        return "–"
    return "> 99 %" if probability > 0.99 else "< 1 %" if probability < 0.01 else percent(round(probability, 2))


def plain_name(effect: str) -> str:
    """coulomb-friction -> Coulomb friction, coulomb_torque -> Coulomb torque."""
    text = effect.replace("-", " ").replace("_", " ")
    for name in ("coulomb", "stribeck"):
        text = text.replace(name, name.capitalize())
    return text


def parameter_name(effect: str, parameter: str) -> str:
    """A parameter with its symbol in the effect's equation: Coulomb torque T_c."""
    among = table()[effect].parameters if effect in table() else ()
    name, sign = plain_name(parameter), next((p.symbol for p in among if p.name == parameter), "")
    return name if not sign or sign == name.replace(" ", "_") else f"{name} {sign}"


def parameter_in_words(name: str) -> str:
    """inertia -> inertia, coulomb-friction.coulomb_torque -> Coulomb torque of Coulomb friction."""
    effect, _, parameter = name.rpartition(".")
    return plain_name(parameter) + (f" of {plain_name(effect)}" if effect else "")


def capital(text: str) -> str:
    """The text with its first letter large, but that of a file."""
    return text if "." in text.partition(" ")[0].rstrip(".,:;") else text[:1].upper() + text[1:]


def listing(names: Sequence[str], joint: str = "and") -> str:
    """a, b and c."""
    *head, last = names
    return f"{', '.join(head)} {joint} {last}" if head else last


def not_tried_in_words(left: NotTried) -> str:
    """A sentence for the warnings, with the first of the names and how many there are."""
    names = [plain_name(name) for name in left.effects]
    more = len(names) - NAMED_AT_ONCE
    if more > 1:
        names = [*names[:NAMED_AT_ONCE], f"{more} others (not_tried in diagnosis.json)"]
    return (
        f"the search ended early: {listing(names)} {'were' if len(names) > 1 else 'was'} not tried in addition to "
        f"{' + '.join(map(plain_name, left.beside))}; --effort 3, or recordings of fewer samples, leave room for more"
    )


def law_in_words(law: Law, *, linear: bool) -> str:
    """One clause: "a torque that depends on angle, 14 periods per revolution, 3 mN m"."""
    size = quantity(law.amplitude, "N" if linear else "N m", 2)
    place = f"angle, {law.periods} periods per revolution" if law.periods else law.coordinate
    return f"a {'force' if linear else 'torque'} that depends on {place}, {size}"


def filter_in_words(signal: str, time_constant: Estimate) -> str:
    """A filter of a sensor that was fitted beside whatever is missing; without an interval it was undone."""
    if time_constant.interval is None:
        return (
            f"The samples of the {signal} went through a first-order filter of {estimate(time_constant)}, seen in its "
            "noise and in its motion: it was undone, and errors are those of the samples before it."
        )
    return (
        f"The {signal} was measured through a first-order filter of {estimate(time_constant)}: "
        "it was fitted as part of the measurement, beside whatever is missing."
    )


def region_in_words(region: Region) -> str:
    """Where a region is, for a sentence: "at high speed", "from 1.33 s to 1.67 s"."""
    if region.name:
        return ("around " if region.name == "reversals" else "at ") + region.name
    if region.coordinate == "direction":
        return "in forward motion" if region.high > 0.0 else "in backward motion"
    if region.coordinate == "angle":
        low, high = (math.degrees(bound) for bound in (region.low, region.high))
        return f"between {low:.0f}° and {high:.0f}° of a turn"
    scale, unit = prefix_for(max(abs(region.low), abs(region.high)), region.unit)
    low_text, high_text = (f"{number(bound * scale)} {unit}".strip() for bound in (region.low, region.high))
    return ("" if region.coordinate == "time" else f"at {region.coordinate} ") + f"from {low_text} to {high_text}"


def shaft_in_words(shaft: ShaftAlone) -> str:
    """How far the shaft alone and the whole drive are from the recorded motion."""
    alone, drive = (quantity(error, SIGNALS[shaft.signal].unit) for error in (shaft.alone, shaft.drive))
    errs = f"errs by {alone} in {shaft.signal}, the whole drive by {drive}"
    return f"driven by the recorded current, the shaft alone {errs}"


def located(
    where: Sequence[Region], laws: Sequence[Law], *, linear: bool, motion: bool = True, shaft: ShaftAlone | None = None
) -> str:
    """What the mismatch depends on and where it is strongest, as one clause; empty where neither is clear.

    `motion`: the regions are of what an equation of motion leaves over, and not of the error of an output. `shaft`:
    without the winding, whose equation the regions are of where the shaft alone moves as recorded.
    """
    winding = shaft is not None and shaft.moves_as_recorded
    parts = [law_in_words(laws[0], linear=linear)] if laws and laws[0].share > CLEAR else []
    if shaft is not None and winding:
        parts.append(f"it lies between the voltage and the current: {shaft_in_words(shaft)}")
    if r := _strongest(where):
        left = f"the {'force' if linear else 'torque'} that the refitted equation of motion leaves over"
        left = "the voltage that the refitted equation of the winding leaves over" if winding else left
        what = left if motion else "the error of the refitted model's output"
        much = f"{percent(r.samples_share)} of the samples hold {percent(r.share)} of its square"
        parts.append(f"{what} is strongest {region_in_words(r)}, where {much}")
    return "; ".join(parts)


def located_briefly(
    where: Sequence[Region], laws: Sequence[Law], *, linear: bool, motion: bool = True, shaft: ShaftAlone | None = None
) -> str:
    """The same as `located` in a few words: what is missing, and where most of it."""
    if laws and laws[0].share > CLEAR:
        return law_in_words(laws[0], linear=linear)
    winding = shaft is not None and shaft.moves_as_recorded
    left = f"a {'force' if linear else 'torque'}" if motion else "an error of the output"
    what = "a voltage of the winding" if winding else left
    if r := _strongest(where):
        return f"{what} that is strongest {region_in_words(r)}"
    return what if winding else ""


def _strongest(where: Sequence[Region]) -> Region | None:
    return next((r for r in where if r.share - r.samples_share > EXCESS), None)
