"""Recordings explained without their mistakes: scales first, what physics might explain too against physics."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from rwn.explain import MOST_EFFECTS, Explanation, Progress, explain
from rwn.gear_ratio import gear_ratio
from rwn.mistakes import GEAR, Mistake, without
from rwn.model import Model
from rwn.out_of_step import CLEAR, LITTLE, SLIGHT, Suspicion, believed, first_effects, rivals, sharpened, suspected, unexplained
from rwn.prepare import prepare
from rwn.recording import Recording
from rwn.wrong_scale import wrong_scale

MOST_SCALES = 2  # wrong at a time
WRONG = 0.01  # relative error of a gear ratio, from which what is beneath it is explained anew


class Explain(Protocol):
    """See `explain`; of recordings in place of what is prepared."""

    def __call__(
        self, of: Sequence[Recording], at_once: int = ..., *, names: Sequence[str] | None = ...,
        after: Explanation | None = ...,
    ) -> Explanation: ...  # fmt: skip


def explained(
    recordings: Sequence[Recording], model: Model, *, say: Progress
) -> tuple[list[Mistake], Explanation]:
    """Mistakes of the recordings, and what explains these when they are undone."""

    def explanation(
        of: Sequence[Recording], at_once: int = MOST_EFFECTS, *, names: Sequence[str] | None = None,
        after: Explanation | None = None,
    ) -> Explanation:  # fmt: skip
        return explain(prepare(of, model), progress=say, at_once=at_once, names=names, after=after)

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
    return _geared(gear, made, recordings, model, found, explanation) if gear else (made, found)


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

    Where two of them explain all there is, only theirs and the foremost are tried beside the mistake. Returned with it
    is what was found on the way of the recordings without it, or as they are; None where that is not known.
    """
    mistake, left = doubt.mistake, doubt.after
    alone = explanation(right, 1)
    physics = unexplained(doubt, alone)
    if physics <= LITTLE:
        return None, alone
    if left <= LITTLE:
        return (mistake, None) if believed(doubt, left=left, physics=physics) else (None, alone)
    pairs = explanation(right, 2, names=rivals(alone), after=alone)
    enough = unexplained(doubt, pairs) <= LITTLE
    beneath = explanation(without(right, mistake), 1, names=first_effects(alone, pairs) if enough else None)
    mistake, left = sharpened(doubt, right, model, beneath)
    if not believed(doubt, left=left, physics=physics):
        return None, pairs
    if left > CLEAR * doubt.before:
        if not enough:
            pairs = explanation(right, 2, names=rivals(alone, beneath), after=pairs)
        if not believed(doubt, left=left, physics=unexplained(doubt, pairs)):
            return None, pairs
    elif unexplained(doubt, pairs) < left + SLIGHT:
        return None, pairs
    return mistake, beneath if mistake is doubt.mistake and not enough else None


def _scaled(recordings: Sequence[Recording], model: Model) -> tuple[list[Mistake], list[Recording]]:
    """Wrong units, signs and gears, and the recordings without them."""
    made: list[Mistake] = []
    right = list(recordings)
    while len(made) < MOST_SCALES and (mistake := wrong_scale(right, model)):
        made.append(mistake)
        right = without(right, mistake)
    return made, right
