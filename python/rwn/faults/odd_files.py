"""A unit or sign that is wrong in some of the recordings, beside others whose motion the model follows."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

from rwn.faults.fault import GEAR, Fault, known_as
from rwn.faults.scale import LEFT, similarity, wrong_scale
from rwn.model.model import Model
from rwn.recording.inspection import Finding
from rwn.recording.recording import Recording


def wrong_in_some(recordings: Sequence[Recording], model: Model) -> Fault | None:
    """A unit or sign that is wrong in some recordings and right in all others, which show it; None where none is.

    One is right where the signals are as large as the model as given simulates them: no physics is another in each
    file of a machine by as much as a unit. A gear is part of the machine.
    """
    found = _odd(recordings, model)
    if found is None:
        return None
    files, others = (", ".join(r.name for r in of) for of in (found.files, found.others))
    meaning = f"{found.fault.meaning}, in {files} and not in {others}"
    return replace(found.fault, recordings=tuple(map(known_as, found.files)), also=(), meaning=meaning)


class _Odd(NamedTuple):
    """A fault of some recordings that the others do not have."""

    fault: Fault
    files: list[Recording]
    others: list[Recording]


def _odd(recordings: Sequence[Recording], model: Model) -> _Odd | None:
    if len({known_as(r) for r in recordings}) < max(len(recordings), 2) or model.drive.coefficients:
        return None
    alone = {known_as(recording): wrong_scale([recording], model) for recording in recordings}
    fault = next((one for one in alone.values() if one is not None), None)
    if fault is None or fault.name == GEAR:
        return None
    odd = [r for r in recordings if _is_same(alone[known_as(r)], fault)]
    others = [r for r in recordings if not _is_same(alone[known_as(r)], fault)]
    if not others or not all(alone[known_as(r)] is None and _follows(r, fault, model) for r in others):
        return None
    return _Odd(fault, odd, others)


def without_unseen_mistakes(
    fitted: Sequence[Recording], unseen: Sequence[Recording], model: Model
) -> tuple[list[Recording], list[Finding]]:
    """Recordings that were not fitted, without a unit or sign that is wrong in them and right in the fitted ones.

    With what is said of it.
    """
    right, found = list(unseen), list[Finding]()
    for k, recording in enumerate(unseen):
        if (odd := _odd([*fitted, recording], model)) is not None and odd.files == [recording]:
            fault = odd.fault
            right[k] = fault.undo(recording)
            found.append(
                Finding(
                    kind=fault.name, recording=recording.name, signals=fault.signals, count=0, words=fault.meaning,
                    done="judged with it undone; correct the file",
                )
            )  # fmt: skip
    return right, found


def _is_same(one: Fault | None, other: Fault) -> bool:
    return one is not None and (one.name, one.signals, one.factor) == (other.name, other.signals, other.factor)


def _follows(recording: Recording, fault: Fault, model: Model) -> bool:
    """Whether the signals of a fault, or all where it is one of the input, are near their simulation as they are."""
    seen = similarity([recording], model)
    judged = [seen[s] for s in fault.signals if s in seen] or list(seen.values())
    return all(not one.far and one.misfit(1.0) < LEFT for one in judged)
