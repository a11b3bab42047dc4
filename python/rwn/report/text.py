"""Numbers and verdicts as people read them: SI prefixes, uncertainty, one sentence."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from rwn.faults.fault import RECORDING
from rwn.fit.intervals import Estimate
from rwn.fit.prior_weight import BELIEVABLE
from rwn.locate.dependence import Law
from rwn.name.found_effect import FoundEffect
from rwn.prove.heldout import HeldoutRow
from rwn.report.diagnosis import Diagnosis

SLIGHT = 0.005  # share of the mismatch that is not worth a sentence
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


def quantity(value: float, unit: str, digits: int = 3) -> str:
    """A value in SI as people read it: 0.0124 "A" as "12.4 mA"."""
    scale, shown = prefix_for(abs(value), unit)
    return f"{number(value * scale, digits)} {shown}".strip()


def estimate(value: Estimate) -> str:
    """A value with its 95 % interval: "20.4 ± 0.3 N", or "20.4 N [19.0, 25.1]" where that is lopsided."""
    if value.interval is None:
        return quantity(value.value, value.unit)
    low, high = value.interval
    below, above = value.value - low, high - value.value
    scale, shown = prefix_for(abs(value.value) or max(abs(low), abs(high)), value.unit)
    half = (high - low) / 2
    if not math.isfinite(half) or half <= 0:
        return quantity(value.value, value.unit)
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
    if 99 <= abs(value) < 100:
        return f"{value:.1f} %" if abs(value) < 99.95 else ("−" if value < 0 else "") + "> 99.9 %"
    return f"{value:.0f} %" if abs(value) >= 10 or value == 0 else f"{value:.1f} %"


def likelihood(probability: float) -> str:
    """A probability as a percentage that never claims certainty."""
    return (
        "> 99 %" if probability > 0.99 else "< 1 %" if probability < 0.01 else percent(round(probability, 2))
    )


def plain_name(effect: str) -> str:
    """coulomb-friction -> Coulomb friction."""
    text = effect.replace("-", " ")
    for name in ("coulomb", "stribeck"):
        text = text.replace(name, name.capitalize())
    return text


def listing(names: Sequence[str], joint: str = "and") -> str:
    """a, b and c."""
    *head, last = names
    return f"{', '.join(head)} {joint} {last}" if head else last


def law_in_words(law: Law, *, linear: bool) -> str:
    """One clause: "a torque that depends on angle, 14 periods per revolution, 3 mN m"."""
    size = quantity(law.amplitude, "N" if linear else "N m", 2)
    place = f"angle, {law.periods} periods per revolution" if law.periods else law.coordinate
    return f"a {'force' if linear else 'torque'} that depends on {place}, {size}"


def verdict_sentence(found: Diagnosis) -> str:
    """The verdict in one sentence."""
    return {
        "missing-physics": _missing,
        "adequate": _adequate,
        "unexplained": _unexplained,
        "insufficient-excitation": _insufficient,
        "recording-mistake": _mistake,
    }[found.verdict](found)


def _missing(found: Diagnosis) -> str:
    parts = [f"{_with_parameters(e)} (probability {likelihood(e.probability)})" for e in found.effects]
    if len(found.set) > 1:
        names = listing([plain_name(name) for name in found.set], "or")
        parts = [f"{names} (these recordings cannot tell which)", *parts[1:]]
    return f"The model lacks {listing(parts)}.{_gain(found)}{_left(found)}"


def _left(found: Diagnosis) -> str:
    """What the stated effects leave, where it has structure."""
    left = found.remainder
    if not left.signals or left.share < SLIGHT:
        return ""
    where = listing(left.signals)
    return f" What they leave of the {where}, {percent(left.share)} of the mismatch, is not noise and has no name here."


def _with_parameters(effect: FoundEffect) -> str:
    values = [estimate(value) for value in effect.parameters.values()]
    return plain_name(effect.name) + (f" of {values[0]}" if len(values) == 1 else "")


def _adequate(found: Diagnosis) -> str:
    fitted = {name: p for name, p in found.nominal_fit.parameters.items() if p.uncertainty > 0}
    far = {name: p.moved for name, p in fitted.items() if p.moved > BELIEVABLE}
    where = "" if far else " within their declared uncertainty"
    tail = f" once its parameters are refitted{where}" if fitted else ""
    sentence = f"The model is adequate{tail}: nothing that these recordings can show is missing."
    for name, times in far.items():
        sentence += f" But {name} had to move by {number(times, 2)} times its declared uncertainty: check it."
    return sentence


def _unexplained(found: Diagnosis) -> str:
    what = found.location.description or f"something in the {found.equation} equation"
    drawn = f" In corrected.toml stands for it: {found.stand_in}." if found.stand_in else ""
    return f"Something is missing that has no name here: {what}.{drawn}{_gain(found)}"


def _insufficient(found: Diagnosis) -> str:
    return (
        f"These recordings do not excite the drive enough to judge the model. {found.next_experiment}".strip()
    )


def _mistake(found: Diagnosis) -> str:
    wrong = [effect for effect in found.effects if effect.equation == RECORDING]
    sentence = f"The recordings hold a mistake: {listing([effect.meaning for effect in wrong])}."
    if found.beneath is None:
        return sentence
    physics = tuple(effect for effect in found.effects if effect.equation != RECORDING)
    rest = replace(found, verdict=found.beneath.verdict, set=found.beneath.set, effects=physics, beneath=None)
    return f"{sentence} With it undone: {verdict_sentence(rest)}"


def headline(found: Diagnosis) -> HeldoutRow | None:
    """The held-out row that says most in one figure: all of the first recording, speed before position."""
    rows = [row for row in found.heldout if row.region == "all"]
    order = ("speed", "position", "current")
    rows = [row for row in rows if row.recording == rows[0].recording]
    return min(
        rows, key=lambda row: order.index(row.signal) if row.signal in order else len(order), default=None
    )


def _gain(found: Diagnosis) -> str:
    row = headline(found)
    if row is None or row.gain is None:
        return ""
    does = "reduces" if row.gain >= 0 else "increases"
    where = f"the {row.signal} error on {row.recording}, not used for fitting"
    return f" Adding it {does} {where}, by {percent(abs(row.gain))}."
