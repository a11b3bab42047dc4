"""What to do with a diagnosis: the next steps, the one that matters most first."""

from __future__ import annotations

from collections.abc import Iterator

from rwn.decide.account import ActingEffect
from rwn.faults.uneven_files import DISAGREE
from rwn.mismatch_map.regions import INSTANTS
from rwn.report.diagnosis_data import DiagnosisData
from rwn.report.held import held_part, holds_no_effect
from rwn.report.proof_sentences import SLIGHT
from rwn.report.text import likelihood, listing, plain_name

_WRITE_IT = (
    "write it as a formula under `[own_effects]` in the model file and diagnose again: it is then fitted and proved "
    "like any other name."
)
NEAR = 0.1  # probability from which a name that is not stated is worth mentioning


def next_steps(found: DiagnosisData) -> tuple[str, ...]:
    """Sentences that each say one thing to do; none where nothing is left to do."""
    made = {
        "missing-physics": _missing,
        "adequate": _adequate,
        "unexplained": _unexplained,
        "insufficient-excitation": _insufficient,
        "recording-mistake": _mistake,
    }[found.verdict](found)
    return (*_apart(found), *made)


def _apart(found: DiagnosisData) -> Iterator[str]:
    """Recordings of different machines are no evidence of what one of them lacks."""
    differ = dict.fromkeys(f.quantity for f in found.findings if f.kind == DISAGREE and f.quantity)
    if differ:
        other = listing([*dict.fromkeys(f.recording for f in found.findings if f.kind == DISAGREE)])
        yield (
            f"{other} and the other recordings are of machines that differ in {listing([*differ])}: diagnose those "
            "that are alike by themselves first."
        )


def _missing(found: DiagnosisData) -> Iterator[str]:
    if found.next_experiment:
        which = "them apart" if len(found.set) > 1 else "it from the next explanations"
        yield f"To tell {which}: {found.next_experiment}"
    if found.remainder.signals and found.remainder.share >= SLIGHT:
        yield f"For what is left: where you know what does it, {_WRITE_IT}"
        yield from _again(found)
    with_effects = held_part(found) or "the effects that were found"
    yield from _use_it("the refitted parameters" if holds_no_effect(found) else with_effects)
    if not any(source.use == "heldout" for source in found.sources) and found.sources:
        yield "Keep one recording back with `--heldout`: a proof on a run of its own is stronger than cross-validation."


def _use_it(with_what: str) -> Iterator[str]:
    command = "rwn simulate corrected.toml --input RECORDING.csv --out simulated.csv"
    yield f"corrected.toml holds the model with {with_what}: `{command}`"


def _adequate(found: DiagnosisData) -> Iterator[str]:
    if found.next_experiment:
        yield found.next_experiment
    yield from _use_it("the refitted parameters")
    yield "What these recordings do not excite is not judged: record the motion that matters before relying on it."


def _unexplained(found: DiagnosisData) -> Iterator[str]:
    laws = [plot for plot in found.curves if plot.slot == "law"]
    if laws:
        yield f"It is drawn over {laws[0].x_label} in the report. Where you know what does that, {_WRITE_IT}"
    near = [e for e in found.account if e.together > NEAR]
    if near:
        yield f"Nearest names, not stated: {listing([_nearest(e) for e in near[:3]], 'and')}."
    if found.next_experiment:
        yield found.next_experiment
    yield from _again(found)
    if found.stand_in:
        yield from _use_it("what stands for it")


def _again(found: DiagnosisData) -> Iterator[str]:
    if found.location.regions and found.location.regions[0].name == INSTANTS:
        yield (
            "Look at the recordings where the error jumps: a logger that loses rows while its times go on evenly, a "
            "glitch of a sensor or a blow shows at single instants, and is no law."
        )
    elif found.location.regions:
        yield (
            "Record again with more of the motion where it is strongest, and one run at half that amplitude: what "
            "grows with it and what does not tells causes apart."
        )


def _nearest(effect: ActingEffect) -> str:
    names = listing([plain_name(name) for name in (effect.name, *effect.rivals)], "or")
    return f"{names} ({likelihood(effect.together)})"


def _insufficient(found: DiagnosisData) -> Iterator[str]:
    yield found.next_experiment or "Record a run that moves both ways, through standstill, with changing input."


def _mistake(found: DiagnosisData) -> Iterator[str]:
    faults = [e for e in found.effects if e.signals]
    if not faults:
        yield "Correct the recording, or the columns and units in the model file, and diagnose again."
    for fault in faults:
        shift = fault.parameters.get("shift")
        if shift is not None:
            lines = ", ".join(f'`delays.{name} = "{1e3 * shift.value:.6g} ms"`' for name in fault.signals)
            yield f"Correct the recording, or write under [recording] in the model file: {lines}. Then diagnose again."
        else:
            factor = fault.parameters["factor"].value if "factor" in fault.parameters else -1.0
            if fault.recordings:  # the columns of a model file are those of all recordings
                times = f"the {listing(fault.signals)} times {1.0 / factor:.6g}"
                yield f"Correct {listing(fault.recordings)}: write {times}, or its unit. Then diagnose again."
                continue
            lines = ", ".join(f"`columns.{name} = {{ scale = {1.0 / factor:.6g} }}`" for name in fault.signals)
            yield f"Correct the recording, or write under [recording] in the model file: {lines}. Then diagnose again."
    if found.next_experiment:
        sets = (found.set, found.beneath.set if found.beneath else ())
        rivals = any(len(names) > 1 for names in sets)
        yield f"To tell the rivals apart: {found.next_experiment}" if rivals else found.next_experiment
    if found.beneath is not None and found.beneath.verdict != "adequate":
        yield "What is said beneath the mistake was found with the mistake undone, and holds if it was undone rightly."
        yield from _use_it("what was found with the mistake undone")
