"""The verdict and its proof in sentences."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

from rwn.decide.account import ActingEffect
from rwn.faults.fault import RECORDING
from rwn.faults.uneven_files import JUDGED_AT_ITS_OWN
from rwn.fit.prior_weight import BELIEVABLE
from rwn.name.found_effect import FoundEffect
from rwn.name.measurement import NEXT_TO_NOTHING
from rwn.prove.heldout import HeldoutRow
from rwn.prove.proof import LEFT_OUT
from rwn.report.diagnosis_data import DiagnosisData
from rwn.report.held import held_part, holds_no_effect
from rwn.report.text import (
    capital,
    estimate,
    likelihood,
    listing,
    number,
    parameter_in_words,
    percent,
    plain_name,
    prefix_for,
    times_given,
)

STANDS_OUT = 2.0  # error in units of the noise, from which three quarters of its square are something else
SHOWN = 0.02  # probability from which an account shows an effect
SLIGHT = NEXT_TO_NOTHING  # of an error too


def verdict_sentence(found: DiagnosisData) -> str:
    """The verdict, its proof and what is left, in a few sentences."""
    return " ".join(sentences(found))


def sentences(found: DiagnosisData) -> tuple[str, ...]:
    """The verdict in one sentence, then what goes with it."""
    said = {
        "missing-physics": _missing,
        "adequate": _adequate,
        "unexplained": _unexplained,
        "insufficient-excitation": _insufficient,
        "recording-mistake": _mistake,
    }[found.verdict](found)
    return (*said, *_by_file(found))


def _by_file(found: DiagnosisData) -> Iterator[str]:
    """What differs between the recordings, and whose of it the corrected model has."""
    differ = dict.fromkeys((f.held, f.quantity) for f in found.findings if f.quantity)
    for held in dict.fromkeys(held for held, _ in differ):
        names = listing([quantity for of, quantity in differ if of == held])
        yield f"The recordings differ in {names}: each is fitted with its own, corrected.toml holds {held}."


def _missing(found: DiagnosisData) -> tuple[str, ...]:
    slight = {e.name for e in found.account if e.share < SLIGHT and e.name not in found.set}
    effects = [e for e in found.effects if e.name not in slight] or found.effects
    parts = [f"{_with_parameters(e)} (probability {likelihood(e.probability)})" for e in effects]
    if len(found.set) > 1:
        names = listing([plain_name(name) for name in found.set], "or")
        either = likelihood(acting(found, found.effects[0])[0])
        parts = [f"{names} (probability {either} of one of them; these recordings cannot tell which)", *parts[1:]]
    them = held_part(found) or ("it" if len(found.effects) == 1 else "them")
    said = f"{_contradiction(found)}The model lacks {listing(parts)}."
    beside = [e for e in found.effects if e not in effects]
    proof = _not_held(found) if holds_no_effect(found) else _proof(found, f"Adding {them}")
    return (said, *proof, *_slight(beside), *_left(found))


def _slight(effects: Sequence[FoundEffect]) -> Iterator[str]:
    """What acts for certain and makes next to no difference, as half a sample of delay beside a friction."""
    if effects:
        names = listing([f"{_with_parameters(e)} (probability {likelihood(e.probability)})" for e in effects])
        show, each = ("shows", "") if len(effects) == 1 else ("show", " each")
        yield f"{capital(names)} {show} too, with less than {percent(SLIGHT)} of the mismatch{each}."


def acting(found: DiagnosisData, effect: FoundEffect) -> tuple[float, tuple[str, ...]]:
    """The probability that an effect or one that may act in its place does, and the names of these."""
    known = next((e for e in found.account if e.name == effect.name), None)
    return (known.together, known.rivals) if known and known.rivals else (effect.probability, ())


def _not_held(found: DiagnosisData) -> Iterator[str]:
    it = "it" if len(found.effects) == 1 else "them"
    yield f"Recordings that were not fitted are simulated better without {it}: corrected.toml leaves {it} out."


def _contradiction(found: DiagnosisData) -> str:
    """A data sheet that is wrong is no measure of what is missing: said first."""
    far = [
        f"{plain_name(name)} ({times_given(p.corrected.value / p.nominal)})"
        for name, p in found.nominal_fit.parameters.items()
        if p.corrected is not None and p.contradicted
    ]
    return f"Data sheet and recordings contradict each other in {listing(far)}. " if far else ""


def _left(found: DiagnosisData) -> Iterator[str]:
    """What the stated effects leave, where it has structure."""
    left = found.remainder
    if left.signals and left.share >= SLIGHT:
        where = listing(left.signals)
        share = f"{percent(left.share)} of the mismatch"
        leave = "it leaves" if len(found.effects) == 1 else "they leave"
        yield f"What {leave} of the {where}, {share}, is not noise and has no name here."


def _with_parameters(effect: FoundEffect) -> str:
    values = [estimate(value) for value in effect.parameters.values()]
    return plain_name(effect.name) + (f" of {values[0]}" if len(values) == 1 else "")


def shown(account: Sequence[ActingEffect]) -> list[ActingEffect]:
    """The effects that an account shows; diagnosis.json has all."""
    return [effect for effect in account if effect.together >= SHOWN]


def about_shares(effects: Sequence[ActingEffect]) -> str:
    """What the shares of these effects and of what is left are of: they are no parts of a whole."""
    said = "A share is what comes back without that effect alone; shares need not add up to 100 %"
    return said + ("." if all(e.stated for e in effects) else ", and what is left includes what is not stated.")


def _adequate(found: DiagnosisData) -> tuple[str, ...]:
    fitted = {name: p for name, p in found.nominal_fit.parameters.items() if p.uncertainty != 0}
    far = {name: p.moved for name, p in fitted.items() if p.moved > BELIEVABLE}
    where = "" if far else " within their declared uncertainty"
    tail = f" once its parameters are refitted{where}" if fitted else ""
    return (
        f"The model is adequate{tail}: nothing that these recordings can show is missing.",
        *(
            f"But {parameter_in_words(name)} had to move by {number(times, 2)} times its declared uncertainty: "
            "check it."
            for name, times in far.items()
        ),
        *_more_than_noise(found),
    )


def _more_than_noise(found: DiagnosisData) -> Iterator[str]:
    """Where an adequate model fails on what it was not fitted to, by the signal that fails most."""
    rows = [row for row in found.heldout if row.region == "all" and row.signal != "position"]
    row = max(rows, key=over_noise, default=None)
    if row is not None and over_noise(row) > STANDS_OUT:
        where = f"the {row.signal} error is {number(over_noise(row), 2)} times its noise"
        where = where if math.isfinite(row.left) else f"the simulated {row.signal} runs away"
        yield f"But on {recording_in_words(row.recording)}, {where}: that run shows what the fitted ones do not."
    elif row is not None and not row.recording.endswith(LEFT_OUT):
        yield from _how_far(found)


def _unexplained(found: DiagnosisData) -> tuple[str, ...]:
    somewhere = f"something in the {found.equation} equation" if found.equation else "the motion is not followed"
    what = found.location.briefly or found.location.description or somewhere
    drawn = (f"In corrected.toml stands for it: {found.stand_in}.",) if found.stand_in else ()
    said = f"Something is missing that has no name here: {what}."
    return (said, *drawn, *(_proof(found, "Adding that") if found.added or drawn else _how_far(found)))


def _how_far(found: DiagnosisData) -> Iterator[str]:
    """How much is missing where nothing was corrected, by the signal that stands out most from its noise."""
    rows = [row for row in found.heldout if row.region == "all" and row.signal != "position"]
    row = max(rows, key=over_noise, default=None)
    if row is None or not row.noise_floor:
        return
    where = recording_in_words(row.recording)
    if not math.isfinite(row.left):
        yield f"On {where}, the simulated {row.signal} runs away."
        return
    times = f"{number(over_noise(row), 2)} times its noise"
    slight = " at most: it is not much" if over_noise(row) < STANDS_OUT else ""
    yield f"On {where}, the refitted model errs by {before_after(row)[1]} in {row.signal}, {times}{slight}."


def _insufficient(found: DiagnosisData) -> tuple[str, ...]:
    said = "These recordings do not excite the drive enough to judge the model."
    return (said, found.next_experiment) if found.next_experiment else (said,)


def _mistake(found: DiagnosisData) -> tuple[str, ...]:
    wrong = [effect for effect in found.effects if effect.equation == RECORDING]
    said = f"The recordings hold a mistake: {listing([effect.meaning for effect in wrong])}."
    if found.beneath is None:
        return (said,)
    physics = tuple(effect for effect in found.effects if effect.equation != RECORDING)
    rest = replace(
        found, verdict=found.beneath.verdict, set=found.beneath.set, effects=physics, beneath=None, findings=()
    )
    first, *others = sentences(rest)
    return (said, f"With it undone: {first}", *others)


def headline(found: DiagnosisData) -> HeldoutRow | None:
    """The held-out row that says most in one figure: all of the first recording, speed before position."""
    rows = [row for row in found.heldout if row.region == "all"]
    order = ("speed", "position", "current")
    rows = [row for row in rows if row.recording == rows[0].recording]
    return min(rows, key=lambda row: order.index(row.signal) if row.signal in order else len(order), default=None)


def before_after(row: HeldoutRow) -> tuple[str, str]:
    """The two errors that a proof compares: refitted and corrected, or where nothing is added as given and refitted."""
    before, after = (row.nominal, row.refitted) if row.corrected is None else (row.refitted, row.corrected)
    scale, unit = row_prefix(row)
    return error_in_words(before, scale, unit), error_in_words(after, scale, unit)


def row_prefix(row: HeldoutRow) -> tuple[float, str]:
    """Scale and unit of the larger of the two errors that the proof compares, so that table and headline are alike."""
    pair = (row.nominal, row.refitted) if row.corrected is None else (row.refitted, row.corrected)
    return prefix_for(max((e for e in pair if math.isfinite(e)), default=0.0), row.unit)


def error_in_words(error: float, scale: float, unit: str) -> str:
    """An error in a unit, or that the simulation ran away."""
    return f"{number(error * scale)} {unit}".strip() if math.isfinite(error) else "ran away"


def over_noise(row: HeldoutRow) -> float:
    """The error that stays, in units of the signal's noise; 0 where that is not known."""
    return row.left / row.noise_floor if row.noise_floor else 0.0


def worse(row: HeldoutRow) -> bool:
    """Whether the correction certainly raises this error."""
    return row.certain_gain[1] < 0.0


def recording_in_words(name: str) -> str:
    """ "run3.csv, which was not fitted", or the part of a recording that cross-validation left out."""
    if name.endswith(LEFT_OUT):
        return f"{name.removesuffix(LEFT_OUT).strip()}, left out of the fit"
    return f"{name}, not used for fitting"


def _proof(found: DiagnosisData, how: str) -> Iterator[str]:
    row = headline(found)
    if row is None or row.corrected is None:
        return
    yield _compared(row, row.corrected, how)
    yield from _at_its_own(found, row)
    for other in found.heldout:
        if other is not row and other.region == "all" and worse(other):
            before, after = before_after(other)
            if not math.isfinite(other.left):
                yield f"But the simulated {other.signal} on {other.recording} runs away."
            elif before != after:  # by less than its figures show is nothing to speak of
                yield f"But the {other.signal} error on {other.recording} gets worse, from {before} to {after}."
        elif _hides(row, other):
            after, times = before_after(other)[1], number(over_noise(other), 2)
            still = f"error there is still {times} times its noise, {after}"
            yield f"The {other.signal} {still if math.isfinite(other.left) else 'there runs away with and without it'}."


def _at_its_own(found: DiagnosisData, row: HeldoutRow) -> Iterator[str]:
    """That a recording was judged with a number of its own, with which no corrected.toml simulates it."""
    for finding in found.findings:
        if finding.recording == row.recording and finding.done.startswith(JUDGED_AT_ITS_OWN):
            yield f"There {finding.words}, and it was judged with its own: with corrected.toml rwn simulate errs more."


def _compared(row: HeldoutRow, corrected: float, how: str) -> str:
    """What a correction does to the error of one recording."""
    before, after = before_after(row)
    there = f"on {recording_in_words(row.recording)},"
    where = f"the {row.signal} error {there}"
    near = f", {number(over_noise(row), 2)} times its noise" if 0.0 < over_noise(row) <= STANDS_OUT else ""
    if not math.isfinite(corrected):
        left = "makes" if math.isfinite(row.refitted) else "does not keep"
        return f"{how} {left} the simulated {row.signal} {there} {'run' if left == 'makes' else 'from running'} away."
    if not math.isfinite(row.refitted):
        return f"{how} keeps the simulated {row.signal} {there} from running away: its error is {after}."
    if corrected == row.refitted or (row.gain is not None and abs(row.gain) < SLIGHT):
        left = near or ": something larger is off there"
        return f"{how} changes nothing in {where} {after}{left}."
    if row.gain_interval is not None and row.gain_interval[0] <= 0.0 <= row.gain_interval[1]:
        return f"{how} changes little for certain: {where} goes from {before}, refitted alone, to {after}."
    does = "increases" if (corrected > row.refitted if row.gain is None else row.gain < 0.0) else "reduces"
    by = f"{percent(abs(row.gain or 0.0))} {'more' if does == 'increases' else 'less'}"
    share = f" ({by})" if row.gain is not None else ""
    as_given = f"; as given, before any fit, the model leaves {error_in_words(row.nominal, *row_prefix(row))}"
    given = as_given if row.nominal < row.refitted else ""
    return f"{how} {does} {where} from {before}, refitted alone, to {after}{near}{share}{given}."


def _hides(row: HeldoutRow, other: HeldoutRow) -> bool:
    """Whether the headline says nothing of what is left in another signal; a position adds up what the speed shows."""
    beside = (other.recording, other.region) == (row.recording, "all") and other.signal not in (row.signal, "position")
    return beside and over_noise(other) > max(STANDS_OUT, over_noise(row))
