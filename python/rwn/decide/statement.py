"""What a diagnosis states in the end: of the drive, and first of mistakes in its recordings where there are any."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from rwn.decide.calibration import calibration
from rwn.decide.decision import Decision
from rwn.decide.verdict import Verdict
from rwn.faults.fault import SURE, Fault
from rwn.name.found_effect import FoundEffect, coarse_speed


@dataclass(frozen=True, kw_only=True)
class Statement:
    """The verdict, and the name that is stated first with those that are not told from it."""

    verdict: Verdict
    names: tuple[str, ...] = ()
    faults: tuple[FoundEffect, ...] = ()  # of the recordings
    coarse: FoundEffect | None = None  # a rounded speed, which is read off the values and not decided
    beneath: Statement | None = None  # what is stated of the drive with the faults undone


def statement(decision: Decision, faults: Sequence[Fault]) -> Statement:
    """What is stated of the drive, beneath the faults of its recordings."""
    drive = _of_the_drive(decision)
    if not faults:
        return drive
    return Statement(
        verdict="recording-mistake",
        names=(faults[0].name, *faults[0].also),
        faults=tuple(fault.found(_probability(fault)) for fault in faults),
        coarse=drive.coarse,
        beneath=drive,
    )


def _of_the_drive(decision: Decision) -> Statement:
    stated = decision.account.stated
    names = (stated[0].name, *stated[0].rivals) if stated else ()
    coarse = coarse_speed(decision.ranking)
    if coarse is None or decision.verdict not in ("adequate", "missing-physics"):
        return Statement(verdict=decision.verdict, names=names)
    return Statement(verdict="missing-physics", names=names or (coarse.name,), coarse=coarse)


def _probability(fault: Fault) -> float:
    """That it is so: plainly where a scale is off, else by what it removes, as of an effect."""
    return calibration().probability_by(**fault.removes._asdict()) if fault.removes else SURE
