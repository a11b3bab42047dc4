"""Recordings explained without their mistakes: scales first, what physics might explain too against physics."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple, Protocol

from rwn import _core
from rwn.faults.delay import (
    BETTER,
    CLEAR,
    LITTLE,
    SLIGHT,
    Suspicion,
    believed,
    first_effects,
    rivals,
    sharpened,
    suspected,
    unexplained,
)
from rwn.faults.fault import GEAR, Mistake, without
from rwn.faults.gear import gear_ratio
from rwn.faults.scale import as_gear, wrong_scale
from rwn.fit.budget import affords_more
from rwn.fit.preparation import prepare
from rwn.model.model import Model
from rwn.name.forward import MOST_EFFECTS, Explanation, Progress, explain
from rwn.recording.recording import Recording

MOST_SCALES = 2  # wrong at a time
MOST_SHARPENED = 3  # times that a delay is told more exactly, with what was found beneath it
WRONG = 0.01  # relative error of a gear ratio, from which what is beneath it is explained anew


class Explain(Protocol):
    """See `explain`; of recordings in place of what is prepared."""

    def __call__(
        self, of: Sequence[Recording], at_once: int = ..., *, names: Sequence[str] | None = ...,
        after: Explanation | None = ...,
    ) -> Explanation: ...  # fmt: skip


class Followed(NamedTuple):
    """A delay, what was found beneath it, and the squared error that is left (see `sharpened`)."""

    mistake: Mistake
    beneath: Explanation
    left: float
    exact: bool  # `beneath` was found with this delay undone, not with one near it


def explained(
    recordings: Sequence[Recording], model: Model, *, say: Progress
) -> tuple[list[Mistake], Explanation]:
    """Mistakes of the recordings, and what explains these when they are undone."""

    work = _core.Work()

    def explanation(
        of: Sequence[Recording], at_once: int = MOST_EFFECTS, *, names: Sequence[str] | None = None,
        after: Explanation | None = None,
    ) -> Explanation:  # fmt: skip
        return explain(prepare(of, model, work=work), progress=say, at_once=at_once, names=names, after=after)

    if model.kind == "lti":  # its gain is in no unit that could be doubted
        return [], explanation(recordings)
    say("looking for mistakes in the recordings", 0.0)
    made, right = _scaled(recordings, model)
    doubt = suspected(right, model)
    say("refitting the nominal model", 0.05)
    mistake, singly = _settled(doubt, right, model, explanation) if doubt else (None, None)
    if mistake:
        made, right = [*made, mistake], without(right, mistake)
    found = singly if singly and singly.complete else explanation(right, after=singly)
    gear = next((m for m in made if m.name == GEAR), None)
    if gear:
        return _geared(gear, made, recordings, model, found, explanation)
    unit = next((m for m in made if GEAR in m.also), None)
    if unit and not found.left.at_the_floor:
        gear = as_gear(unit, model)
        others = [gear if m is unit else m for m in made]
        geared, beneath = _geared(gear, others, recordings, model, found, explanation)
        if beneath.left.at_the_floor:  # of another ratio than the unit's
            return geared, beneath
    return made, found


def _geared(
    gear: Mistake, made: Sequence[Mistake], recordings: Sequence[Recording], model: Model, found: Explanation,
    explanation: Explain,
) -> tuple[list[Mistake], Explanation]:  # fmt: skip
    """The mistakes with the ratio of the gear fitted, and what explains the recordings then."""
    others = [m for m in made if m is not gear]
    for mistake in others:
        recordings = without(recordings, mistake)
    fitted = gear_ratio(gear, recordings, model, found)
    if abs(fitted.factor / gear.factor - 1.0) < WRONG:
        return list(made), found
    return [*others, fitted], explanation(without(recordings, fitted))


def _settled(
    doubt: Suspicion, right: Sequence[Recording], model: Model, explanation: Explain
) -> tuple[Mistake | None, Explanation | None]:
    """The suspected mistake if it explains more, alone or beside one effect, than as many effects do by themselves.

    Or if all there is is explained beneath it, by however many. Where two effects explain all without it, only theirs
    and the foremost are tried beside it. Returned with it is what was found on the way of the recordings without it,
    or as they are; None where that is not known.
    """
    alone = explanation(right, 1)
    physics = unexplained(doubt, alone)
    if physics <= doubt.little:
        return None, alone
    if doubt.after <= LITTLE:
        told = believed(doubt, left=doubt.after, physics=physics, little=doubt.little)
        return (doubt.mistake, None) if told else (None, alone)
    pairs = explanation(right, 2, names=rivals(alone), after=alone)
    enough = unexplained(doubt, pairs) <= LITTLE
    names = first_effects(alone, pairs) if enough else None
    mistake, beneath, left, exact = _followed(doubt, right, model, explanation, names)
    if not believed(doubt, left=left, physics=physics):
        if enough or not exact or left > BETTER * physics:
            return None, pairs
        beneath = explanation(without(right, mistake), after=beneath)
        return (mistake, beneath) if unexplained(doubt, beneath) <= LITTLE else (None, pairs)
    if left > CLEAR * doubt.before:
        if not enough:
            pairs = explanation(right, 2, names=rivals(alone, beneath), after=pairs)
        if not believed(doubt, left=left, physics=unexplained(doubt, pairs)):
            return None, pairs
    elif unexplained(doubt, pairs) < left + SLIGHT:
        return None, pairs
    return mistake, beneath if exact and not enough else None


def _followed(
    doubt: Suspicion, right: Sequence[Recording], model: Model, explanation: Explain, names: Sequence[str] | None
) -> Followed:
    """The suspected delay, told again by what is found beneath it until that tells the same."""
    mistake = doubt.mistake
    for _ in range(MOST_SHARPENED):
        undone = mistake
        beneath = explanation(without(right, undone), 1, names=names)
        mistake, left = sharpened(replace(doubt, mistake=undone), right, model, beneath)
        if mistake is undone or not affords_more(beneath.setup.problem.work):
            break
    return Followed(mistake, beneath, left, mistake is undone)


def _scaled(recordings: Sequence[Recording], model: Model) -> tuple[list[Mistake], list[Recording]]:
    """Wrong units, signs and gears, and the recordings without them."""
    made: list[Mistake] = []
    right = list(recordings)
    while len(made) < MOST_SCALES and (mistake := wrong_scale(right, model)):
        made.append(mistake)
        right = without(right, mistake)
    return made, right
