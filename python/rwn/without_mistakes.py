"""Recordings explained without their mistakes: scales first, what physics might explain too against physics."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from rwn.explain import MOST_EFFECTS, Explanation, Progress, explain
from rwn.gear_ratio import gear_ratio
from rwn.mistakes import GEAR, Mistake, without
from rwn.model import Model
from rwn.out_of_step import CLEAR, LITTLE, Suspicion, believed, rivals, sharpened, suspected, unexplained
from rwn.prepare import prepare
from rwn.recording import Recording
from rwn.wrong_scale import wrong_scale

Explain = Callable[[Sequence[Recording], int, Sequence[str] | None], Explanation]  # by so many effects, of these names

MOST_SCALES = 2  # wrong at a time
WRONG = 0.01  # relative error of a gear ratio, from which what is beneath it is explained anew


def explained(
    recordings: Sequence[Recording], model: Model, *, say: Progress
) -> tuple[list[Mistake], Explanation]:
    """Mistakes of the recordings, and what explains these when they are undone."""

    def explanation(
        of: Sequence[Recording], at_once: int = MOST_EFFECTS, names: Sequence[str] | None = None
    ) -> Explanation:
        return explain(prepare(of, model), progress=say, at_once=at_once, names=names)

    if model.kind == "lti":  # its gain is in no unit that could be doubted
        return [], explanation(recordings)
    say("looking for mistakes in the recordings", 0.0)
    made, right = _scaled(recordings, model)
    doubt = suspected(right, model)
    say("refitting the nominal model", 0.05)
    mistake, found = _settled(doubt, right, model, explanation) if doubt else (None, None)
    if mistake:
        made, right = [*made, mistake], without(right, mistake)
    found = found or explanation(right)
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
    return [*others, fitted], explanation(without(recordings, fitted), MOST_EFFECTS, None)


def _settled(
    doubt: Suspicion, right: Sequence[Recording], model: Model, explanation: Explain
) -> tuple[Mistake | None, Explanation | None]:
    """The suspected mistake if it explains more, alone or beside one effect, than as many effects do by themselves.

    If it does not, what explains the recordings as they are, where one effect is found to do.
    """
    mistake, left, beneath = doubt.mistake, doubt.after, None
    alone = explanation(right, 1, None)
    physics = unexplained(doubt, alone)
    nothing = None, alone if alone.complete else None
    if physics <= LITTLE:
        return nothing
    if left > LITTLE:
        beneath = explanation(without(right, mistake), 1, None)
        mistake, left = sharpened(doubt, right, model, beneath)
    if not believed(doubt, left=left, physics=physics):
        return nothing
    if beneath and left > CLEAR * doubt.before:
        pairs = explanation(right, 2, rivals(alone, beneath))
        if not believed(doubt, left=left, physics=unexplained(doubt, pairs)):
            return nothing
    return mistake, None


def _scaled(recordings: Sequence[Recording], model: Model) -> tuple[list[Mistake], list[Recording]]:
    """Wrong units, signs and gears, and the recordings without them."""
    made: list[Mistake] = []
    right = list(recordings)
    while len(made) < MOST_SCALES and (mistake := wrong_scale(right, model)):
        made.append(mistake)
        right = without(right, mistake)
    return made, right
