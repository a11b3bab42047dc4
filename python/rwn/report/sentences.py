"""The verdict and its proof in sentences."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

from rwn.decide.account import ActingEffect
from rwn.faults.fault import RECORDING
from rwn.fit.prior_weight import BELIEVABLE
from rwn.name.found_effect import FoundEffect
from rwn.prove.proof import LEFT_OUT
from rwn.report.diagnosis_data import DiagnosisData
from rwn.report.held import held_part, holds_no_effect
from rwn.report.proof_sentences import (
    SLIGHT,
    STANDS_OUT,
    how_far,
    over_noise,
    proof_of,
    recording_in_words,
    refitted_alone,
)
from rwn.report.text import (
    capital,
    estimate,
    likelihood,
    listing,
    number,
    parameter_in_words,
    percent,
    plain_name,
    times_given,
)

SHOWN = 0.02  # probability from which an account shows an effect


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
    proof = _not_held(found) if holds_no_effect(found) else proof_of(found, f"Adding {them}")
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
    yield f"Recordings that were not fitted are together simulated better without {it}: corrected.toml leaves {it} out."
    yield from refitted_alone(found)


def _contradiction(found: DiagnosisData) -> str:
    """A data sheet that is wrong is no measure of what is missing: said first."""
    far = [
        f"{plain_name(name)} ({times_given(p.corrected.value / p.nominal, declared=p.uncertainty or 0.0)})"
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
        yield f"But on {recording_in_words(row)}, {where}: that run shows what the fitted ones do not."
    elif row is not None and not row.recording.endswith(LEFT_OUT):
        yield from how_far(found)


def _unexplained(found: DiagnosisData) -> tuple[str, ...]:
    somewhere = f"something in the {found.equation} equation" if found.equation else "the motion is not followed"
    what = found.location.briefly or found.location.description or somewhere
    drawn = (f"In corrected.toml stands for it: {found.stand_in}.",) if found.stand_in else ()
    said = f"Something is missing that has no name here: {what}."
    return (said, *drawn, *(proof_of(found, "Adding that") if found.added or drawn else how_far(found)))


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
