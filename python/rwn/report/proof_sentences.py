"""The proof on recordings that were not fitted, in sentences: what a correction does to the error there."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial

from rwn.faults.uneven_files import JUDGED_AT_ITS_OWN
from rwn.measurement.unrecorded_input import TOLD
from rwn.name.measurement import NEXT_TO_NOTHING
from rwn.prove.heldout import HeldoutRow
from rwn.prove.proof import LEFT_OUT
from rwn.report.diagnosis_data import DiagnosisData
from rwn.report.text import listing, number, percent, prefix_for

STANDS_OUT = 2.0  # error in units of the noise, from which three quarters of its square are something else
SLIGHT = NEXT_TO_NOTHING  # of an error too


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


def recording_in_words(row: HeldoutRow) -> str:
    """ "run3.csv, not used for fitting", or the part of a recording that cross-validation left out."""
    name = row.recording
    if name.endswith(LEFT_OUT):
        return f"{name.removesuffix(LEFT_OUT).strip()}, left out of the fit"
    return f"{name}, not used for fitting" + (" but for numbers of its own" if row.simulated is not None else "")


def proof_of(found: DiagnosisData, how: str) -> Iterator[str]:
    """What `how`, as "Adding it", does to the errors that say most, and to those that it raises."""
    row = headline(found)
    if row is None or row.corrected is None:
        return
    yield _compared(row, row.corrected, how)
    yield from _at_its_own(found, row)
    for other in filter(partial(_disagrees, row), found.heldout):
        before, after = before_after(other)
        yield f"On {other.recording} it goes from {before} to {after}: these two recordings contradict each other."
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
    """What of a recording was judged with numbers of its own, and how far corrected.toml errs without them."""
    if row.simulated is None:
        return
    here = [f for f in found.findings if f.recording == row.recording]
    own = [f.words for f in here if f.done.startswith(JUDGED_AT_ITS_OWN)]
    if any(f.done == TOLD for f in here):
        own.append("its input between the rows was told by its motion")
    what = listing(own or ["it has numbers of its own"])
    error = error_in_words(row.simulated, *prefix_for(row.simulated, row.unit))
    if error == before_after(row)[1]:  # by less than its figures show is nothing to speak of
        return
    instead = f"not {before_after(row)[1]}" if row.simulated <= row.nominal else "more than the model as given"
    yield f"There {what}; as rwn simulate runs corrected.toml, without that, it errs by {error}, {instead}."


def _compared(row: HeldoutRow, corrected: float, how: str) -> str:
    """What a correction does to the error of one recording."""
    before, after = before_after(row)
    there = f"on {recording_in_words(row)},"
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


def _disagrees(row: HeldoutRow, other: HeldoutRow) -> bool:
    """Whether another recording has the same signal certainly better, and this one certainly worse."""
    alike = (other.region, other.signal) == (row.region, row.signal) and other.recording != row.recording
    return alike and worse(row) and other.certain_gain[0] > 0.0


def refitted_alone(found: DiagnosisData) -> Iterator[str]:
    """What the parameters do by themselves, where nothing was added to the model."""
    row = headline(found)
    if row is not None and row.corrected is None:
        before, after = before_after(row)
        where = f"the {row.signal} error on {recording_in_words(row)},"
        yield f"With the refitted parameters alone {where} goes from {before}, as given, to {after}."


def _hides(row: HeldoutRow, other: HeldoutRow) -> bool:
    """Whether the headline says nothing of what is left in another signal; a position adds up what the speed shows."""
    beside = (other.recording, other.region) == (row.recording, "all") and other.signal not in (row.signal, "position")
    return beside and over_noise(other) > max(STANDS_OUT, over_noise(row))


def how_far(found: DiagnosisData) -> Iterator[str]:
    """How much is missing where nothing was corrected, by the signal that stands out most from its noise."""
    rows = [row for row in found.heldout if row.region == "all" and row.signal != "position"]
    row = max(rows, key=over_noise, default=None)
    if row is None or not row.noise_floor:
        return
    where = recording_in_words(row)
    if not math.isfinite(row.left):
        yield f"On {where}, the simulated {row.signal} runs away."
        return
    times = f"{number(over_noise(row), 2)} times its noise"
    slight = " at most: it is not much" if over_noise(row) < STANDS_OUT else ""
    yield f"On {where}, the refitted model errs by {before_after(row)[1]} in {row.signal}, {times}{slight}."
