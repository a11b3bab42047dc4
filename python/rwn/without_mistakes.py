"""Recordings explained without their mistakes: units and signs first, what physics might explain too afterwards."""

from __future__ import annotations

from collections.abc import Sequence

from rwn import mistakes
from rwn.explain import Explanation, Progress, explain
from rwn.mistakes import Mistake
from rwn.model import Model
from rwn.prepare import prepare
from rwn.recording import Recording


def explained(
    recordings: Sequence[Recording], model: Model, *, jobs: int, say: Progress
) -> tuple[list[Mistake], Explanation]:
    """Mistakes of the recordings, and what explains these when they are undone."""
    say("looking for mistakes in the recordings", 0.0)
    made, recordings = _undone(recordings, model)
    say("refitting the nominal model", 0.05)
    if mistakes.suspected(recordings, model):  # before contradictions are explained by several effects at once
        simplest = explain(prepare(recordings, model), jobs=jobs, progress=say, at_once=1)
        made, recordings = _without(_late(simplest, recordings, model), made, recordings)
    found = explain(prepare(recordings, model), jobs=jobs, progress=say)
    late = _late(found, recordings, model)
    if late:
        made, recordings = _without(late, made, recordings)
        found = explain(prepare(recordings, model), jobs=jobs, progress=say)
    return made, found


def _without(
    mistake: Mistake | None, made: list[Mistake], recordings: Sequence[Recording]
) -> tuple[list[Mistake], Sequence[Recording]]:
    """One more mistake, if any, and the recordings without it."""
    return ([*made, mistake], [mistake.undo(r) for r in recordings]) if mistake else (made, recordings)


def _undone(recordings: Sequence[Recording], model: Model) -> tuple[list[Mistake], list[Recording]]:
    """At most two gross mistakes, and the recordings without them."""
    made: list[Mistake] = []
    right = list(recordings)
    if model.kind == "lti":  # its gain is in no unit that could be doubted
        return made, right
    while len(made) < 2 and (mistake := mistakes.gross(right, model)):
        made.append(mistake)
        right = [mistake.undo(r) for r in right]
    return made, right


def _late(found: Explanation, recordings: Sequence[Recording], model: Model) -> Mistake | None:
    """A mistake that physics might explain as well, and does not."""
    if model.kind == "lti" or found.nominal.cost < mistakes.AT_THE_NOISE * found.before.count:
        return None
    best = min(h.fitted.cost for h in found.hypotheses)
    return mistakes.fine(recordings, model, noise=found.setup.problem.noise, rival=best)
