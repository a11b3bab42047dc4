"""From explanations to a verdict: which one is chosen, whether it is enough, and how far it may be the whole truth.

docs/method-details.md tells what the constants were set on; only trials of unseen test seeds judge them.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rwn.correct import excitation
from rwn.correct.corrected_model import deviations
from rwn.decide.refuse import PROVED, removed_certainly
from rwn.fit.prior_weight import farthest
from rwn.fit.residuals import Hypothesis, join
from rwn.fit.secant import rough
from rwn.name.backward import plainer
from rwn.name.forward import Explanation
from rwn.prove.proof import LEFT_OUT, hurts
from rwn.report.diagnosis import BELIEVABLE, NEAREST, HeldoutRow, Verdict

REMOVED = 0.99  # share of the removable squared error that a name has to remove where more than noise is left
PARTLY = 0.75  # the same where held-out recordings prove it: real machines have small effects beside the large one
ANOTHER = 0.4  # at most so probable is a name that leaves a curve over one state, which no right name does
ELABORATE = 5.0  # how much more probable than plain friction its elaboration has to be to be named
INEXACT = 0.002  # relative change in squared error that the simulation's own error may make
ROUGH = 0.05  # the same where a contact makes the error rough
SIMULATED = 1e-6  # share of the squared error that an explanation removes, to which the simulation is exact
DOUBTFUL = 2.0  # squared error of a signal, in units of its noise, from which it is off at all
COARSELY = 0.5  # share of the squared error of a coarse speed that a name has to be below, whatever its steps
MATERIAL = 0.015  # smallest relative gain in squared error that is called physics


def choose(found: Explanation) -> Hypothesis:
    """The most probable explanation, with plain friction where its elaboration is hardly more so or fits no better;
    nothing where the gain is not material and the nominal model fits as well within what was declared of it."""
    first = found.hypotheses[0]
    missing, left = found.nothing_missing.fitted.minimum.chi2, first.fitted.minimum.chi2
    plain = [h for h in found.hypotheses if set(h.fitted.added) == plainer(first.fitted.added)]
    inexact = (ROUGH if rough(first.fitted.candidate) else INEXACT) * left + SIMULATED * (missing - left)
    if plain and (
        plain[0].probability > first.probability / ELABORATE or plain[0].fitted.minimum.chi2 - left < inexact
    ):
        first = plain[0]
    return first if _is_material(found, first) or _beyond_belief(found, first) else found.nothing_missing


def _is_material(found: Explanation, h: Hypothesis) -> bool:
    """Whether the recordings alone, whatever was declared, are explained better.

    Where the speed is coarse its steps count as noise, but what they do on average was taken out of it: what is left
    of half of that is no chance.
    """
    nothing = found.nothing_missing
    if found.speed_steps and _variances(found, h)["speed"] < COARSELY * _variances(found, nothing)["speed"]:
        return True
    return 1.0 - _above_noise(found, h) / _above_noise(found, nothing) >= MATERIAL


def _beyond_belief(found: Explanation, h: Hypothesis) -> bool:
    """Whether without `h` the nominal model has to leave what was declared of it, and with it has not."""
    return farthest(h.fitted) <= BELIEVABLE < farthest(found.nothing_missing.fitted)


def rests_on_what_was_declared(found: Explanation, h: Hypothesis) -> bool:
    """Whether the nominal model would explain the recordings as well, had nothing been declared of it."""
    return bool(h.fitted.added) and not _is_material(found, h)


def verdict_of(found: Explanation, chosen: Hypothesis, *, certain: bool = False) -> Verdict:
    """Found, nothing missing, something without a name, or nothing to be learned from these recordings.

    `certain`: held-out recordings prove the explanation, so that it need not remove all.
    """
    after = chosen.fitted.minimum.chi2 / max(found.left.count, 1)
    left_over = not found.left.at_the_floor
    if not chosen.fitted.added:
        if left_over and after > 1.0 + 2.0 * MATERIAL:
            return "unexplained"
        return "insufficient-excitation" if _nothing_learned(found) else "adequate"
    enough = _removed(found, chosen) >= _enough(certain)
    return "unexplained" if left_over and not enough else "missing-physics"


def _enough(certain: bool) -> float:
    """Share of the removable squared error that a name has to remove."""
    return PARTLY if certain else REMOVED


def refused(found: Explanation, chosen: Hypothesis, rows: Sequence[HeldoutRow]) -> bool:
    """Whether data that were not fitted refuse a name.

    Recordings that were kept back always may. A part left out of the fit may not where the name explains the whole: a
    free run that goes on for long can lose the motion for parameters that are a little off (a cog too far).
    """
    off = found.before.variance > DOUBTFUL
    explains = off and _removed(found, chosen) > REMOVED
    return hurts(rows) and not (explains and all(LEFT_OUT in r.recording for r in rows))


def _removed(found: Explanation, chosen: Hypothesis) -> float:
    """Share of the removable squared error that is removed, of the signal where it is least.

    A free-running position is an integral: what merely stops its drift may leave the speed as wrong as before.
    """
    before, after = (_variances(found, h) for h in (found.nothing_missing, chosen))
    off = [s for s in before if before[s] > DOUBTFUL] or list(before)
    return min(1.0 - max(after[s] - 1.0, 0.0) / max(before[s] - 1.0, 1e-12) for s in off)


def whole(found: Explanation, chosen: Hypothesis, *, certain: bool = False, another: bool = False) -> float:
    """How probable it is that what was found is the whole of what is missing, from the share that it leaves.

    A right name leaves noise; a cubic drag called quadratic leaves some per cent of the mismatch. It is half where as
    much is left as an unproved name may leave; a proved one halves once more where it would no longer be given.
    `another`: a law without a name is seen in it (another_law).
    """
    most = ANOTHER if another else 1.0
    if found.left.at_the_floor:
        return most
    left = 1.0 - _removed(found, chosen)
    alone = 1.0 / (1.0 + (left / (1.0 - REMOVED)) ** 2)
    beside = NEAREST / (1.0 + (left / (1.0 - PARTLY)) ** 2) if certain else 0.0
    return min(most, max(alone, beside))


def _above_noise(found: Explanation, h: Hypothesis) -> float:
    """Mean squared errors of the signals, none less than its noise: what is gained below it is no gain."""
    return sum(max(v, 1.0) for v in _variances(found, h).values())


def _variances(found: Explanation, h: Hypothesis) -> dict[str, float]:
    """Mean squared error of each signal in units of its noise."""
    problem = found.setup.problem
    residuals = problem.residuals(h.fitted.vector, h.fitted.candidate.active)
    return {s: float(np.nanmean(r**2)) for s, r in join(problem, residuals).items()}


def verdict_without_a_name(found: Explanation) -> Verdict:
    """The verdict where data that were not fitted refuse every name."""
    return "adequate" if found.before.at_the_floor else "unexplained"


def _nothing_learned(found: Explanation) -> bool:
    fitted = found.nominal
    spread = deviations(fitted, found.before.variance, found.before.correlation_time)
    return excitation.learns_nothing(fitted.candidate, spread, fitted.minimum.values)


def is_certain(rows: Sequence[HeldoutRow]) -> bool:
    """Whether recordings that were kept back prove a good part (PROVED) of the squared error removed, at the least."""
    kept_back = bool(rows) and not any(LEFT_OUT in r.recording for r in rows)
    return kept_back and removed_certainly(rows) > PROVED
