"""Recordings explained without their faults: scales first, what physics might explain too against physics."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple, Protocol

from rwn.faults.delay import (
    BETTER,
    LITTLE,
    SLIGHT,
    SuspectedFault,
    accepted,
    first_effects,
    refined,
    removing,
    rivals,
    suspected,
    unexplained,
)
from rwn.faults.fault import GEAR, Fault, without, without_all
from rwn.faults.gear import gear_ratio, is_needless
from rwn.faults.plain_faults import plain_faults
from rwn.faults.scale import as_gear
from rwn.fit.budget import affords_more, meter
from rwn.fit.fit import Fit
from rwn.fit.preparation import prepare
from rwn.measurement.filter_colour import SensorFilter
from rwn.model.model import Model
from rwn.name.forward import MOST_EFFECTS, Progress, rank
from rwn.name.ranking import Ranking
from rwn.recording.recording import Recording

MOST_REFINEMENTS = 3  # times that a delay is refined with the physics that was found once it was undone
WRONG = 0.01  # relative error of a gear ratio, from which the recordings are explained anew with the better one


class Rank(Protocol):
    """See `rank`; of recordings in place of what is prepared."""

    def __call__(
        self, of: Sequence[Recording], at_once: int = ..., *, names: Sequence[str] | None = ...,
        after: Ranking | None = ...,
    ) -> Ranking: ...  # fmt: skip


class _FaultTest(NamedTuple):
    """What came of a suspicion, with what was found on the way of the recordings without the fault, or as they are."""

    fault: Fault | None
    found: Ranking | None  # None: not known
    physics: float = 0.0  # squared error above the noise that physics leaves with the fault in the recordings


NO_FAULT = _FaultTest(None, None)


class _RefinedDelay(NamedTuple):
    """A delay, what was found beneath it, and the squared error that is left (see `refined`)."""

    fault: Fault
    beneath: Ranking
    left: float
    exact: bool  # `beneath` was found with this delay undone, not with one near it


def beneath_faults(
    recordings: Sequence[Recording], model: Model, *, filters: Sequence[SensorFilter] = (), known: Sequence[Fit] = (),
    say: Progress, effort: float = 1.0,
) -> tuple[list[Fault], Ranking]:  # fmt: skip
    """Faults of the recordings, and what explains these when they are undone.

    `filters`: of the sensors, that are known already. `known`: explanations that were found while the recordings were
    thought to have come about otherwise. `effort`: see `budget.meter`.
    """

    def ranking(
        of: Sequence[Recording], at_once: int = MOST_EFFECTS, *, names: Sequence[str] | None = None,
        after: Ranking | None = None,
    ) -> Ranking:  # fmt: skip
        problem = prepare(of, model, work=meter(effort))
        among = known if names is None and at_once == MOST_EFFECTS else ()
        return rank(
            problem, progress=say, at_once=at_once, names=names, after=after, filters=filters, known=among
        )  # fmt: skip

    if model.drive.coefficients:  # its gain is in no unit that could be doubted
        return [], ranking(recordings)
    say("looking for faults in the recordings", 0.0)
    made, right = plain_faults(recordings, model)
    suspect = suspected(right, model)
    say("refitting the nominal model", 0.05)
    fault, singly, physics = _decided(suspect, right, model, ranking) if suspect else NO_FAULT
    if fault:
        right = without(right, fault)
    found = singly if singly and singly.complete else ranking(right, after=singly)
    if suspect and fault:
        made = [*made, removing(fault, suspect, left=unexplained(suspect, found), physics=physics)]
    gear = next((m for m in made if m.name == GEAR), None)
    if gear:
        return _geared(gear, made, recordings, model, found, ranking)
    unit = next((m for m in made if GEAR in m.also), None)
    if unit and not found.left.at_the_floor:
        gear = as_gear(unit, model)
        others = [gear if m is unit else m for m in made]
        geared, beneath = _geared(gear, others, recordings, model, found, ranking)
        if beneath.left.at_the_floor:  # of another ratio than the unit's
            return geared, beneath
    return made, found


def _geared(
    gear: Fault, made: Sequence[Fault], recordings: Sequence[Recording], model: Model, found: Ranking,
    ranking: Rank,
) -> tuple[list[Fault], Ranking]:  # fmt: skip
    """The faults with the ratio of the gear fitted, or without it, and what explains the recordings then."""
    others = [m for m in made if m is not gear]
    recordings = without_all(recordings, others)
    fitted = gear_ratio(gear, recordings, model, found)
    plain = ranking(recordings)
    if is_needless(gear, fitted, recordings, model, found, plain):
        return others, plain
    if abs(fitted.factor / gear.factor - 1.0) < WRONG:
        return list(made), found
    return [*others, fitted], ranking(without(recordings, fitted))


def _decided(
    suspect: SuspectedFault, right: Sequence[Recording], model: Model, ranking: Rank
) -> _FaultTest:
    """The suspected fault if it explains more, alone or beside one effect, than as many effects do by themselves.

    Or if all there is is explained beneath it, by however many. Where two effects explain all without it, only theirs
    and the best few are tried beside it. Returned with it is what was found on the way of the recordings without it,
    or as they are; None where that is not known.
    """
    alone = ranking(right, 1)
    physics = unexplained(suspect, alone)
    if physics <= suspect.little:
        return _FaultTest(None, alone)
    if suspect.after <= LITTLE:
        believed = accepted(suspect, left=suspect.after, physics=physics, little=suspect.little)
        return _FaultTest(suspect.fault, None, physics) if believed else _FaultTest(None, alone)
    pairs = ranking(right, 2, names=rivals(alone), after=alone)
    enough = unexplained(suspect, pairs) <= LITTLE
    names = first_effects(alone, pairs) if enough else None
    fault, beneath, left, exact = _refined(suspect, right, model, ranking, names)
    if not accepted(suspect, left=left, physics=physics):
        if enough or not exact or left > BETTER * physics:
            return _FaultTest(None, pairs)
        beneath = ranking(without(right, fault), after=beneath)
        believed = unexplained(suspect, beneath) <= LITTLE
        return _FaultTest(fault, beneath, unexplained(suspect, pairs)) if believed else _FaultTest(None, pairs)
    if not enough:
        pairs = ranking(right, 2, names=rivals(alone, beneath), after=pairs)
    physics = unexplained(suspect, pairs)
    if physics < left + SLIGHT or not accepted(suspect, left=left, physics=physics):
        return _FaultTest(None, pairs)
    return _FaultTest(fault, beneath if exact and not enough else None, physics)


def _refined(
    suspect: SuspectedFault, right: Sequence[Recording], model: Model, ranking: Rank, names: Sequence[str] | None
) -> _RefinedDelay:
    """The suspected delay, refined with what is found beneath it until it stays the same."""
    fault = suspect.fault
    for _ in range(MOST_REFINEMENTS):
        undone = fault
        beneath = ranking(without(right, undone), 1, names=names)
        fault, left = refined(replace(suspect, fault=undone), right, model, beneath)
        if fault is undone or not affords_more(beneath.problem.work):
            break
    return _RefinedDelay(fault, beneath, left, fault is undone)
