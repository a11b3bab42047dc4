"""From explanations to a verdict: which one is chosen, whether it is enough, and how far it may be the whole truth.

docs/method-details.md tells what the constants were set on; only trials of unseen test seeds judge them.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import numpy as np

from rwn.decide import excitation
from rwn.decide.refuse import PROVED, removed_certainly
from rwn.fit.intervals import deviations
from rwn.fit.prior_weight import BELIEVABLE
from rwn.fit.residuals import join
from rwn.fit.secant import rough
from rwn.name.backward import plainer
from rwn.name.ranking import Ranking
from rwn.name.weights import RankedFit
from rwn.prove.heldout import HeldoutRow
from rwn.prove.proof import LEFT_OUT, hurts

Verdict = Literal[
    "missing-physics", "adequate", "unexplained", "insufficient-excitation", "recording-mistake"
]

NEAREST = 0.5  # most that a proved name which leaves more than noise is believed to be the whole
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


def choose(ranking: Ranking) -> RankedFit:
    """The most probable explanation, with plain friction where its elaboration is hardly more so or fits no better;
    nothing where the gain is not material and the nominal model fits as well within what was declared of it."""
    first = ranking.fits[0]
    missing, left = ranking.nothing_missing.fit.minimum.chi2, first.fit.minimum.chi2
    plain = [h for h in ranking.fits if set(h.added) == plainer(first.added)]
    inexact = (ROUGH if rough(first.fit.hypothesis) else INEXACT) * left + SIMULATED * (missing - left)
    if plain and (
        plain[0].probability > first.probability / ELABORATE or plain[0].fit.minimum.chi2 - left < inexact
    ):
        first = plain[0]
    return first if _is_material(ranking, first) or _beyond_belief(ranking, first) else ranking.nothing_missing


def _is_material(ranking: Ranking, h: RankedFit) -> bool:
    """Whether the recordings alone, whatever was declared, are explained better.

    Where the speed is coarse its steps count as noise, but what they do on average was taken out of it: what is left
    of half of that is no chance.
    """
    nothing = ranking.nothing_missing
    if ranking.speed_steps and _variances(ranking, h)["speed"] < COARSELY * _variances(ranking, nothing)["speed"]:
        return True
    return 1.0 - _above_noise(ranking, h) / _above_noise(ranking, nothing) >= MATERIAL


def _beyond_belief(ranking: Ranking, h: RankedFit) -> bool:
    """Whether without `h` the nominal model has to leave what was declared of it, and with it has not."""
    return h.fit.farthest_move <= BELIEVABLE < ranking.nothing_missing.fit.farthest_move


def rests_on_what_was_declared(ranking: Ranking, h: RankedFit) -> bool:
    """Whether the nominal model would explain the recordings as well, had nothing been declared of it."""
    return bool(h.added) and not _is_material(ranking, h)


def verdict_of(ranking: Ranking, chosen: RankedFit, *, certain: bool = False) -> Verdict:
    """Found, nothing missing, something without a name, or nothing to be learned from these recordings.

    `certain`: held-out recordings prove the explanation, so that it need not remove all.
    """
    after = chosen.fit.minimum.chi2 / max(ranking.left.count, 1)
    left_over = not ranking.left.at_the_floor
    if not chosen.added:
        if left_over and after > 1.0 + 2.0 * MATERIAL:
            return "unexplained"
        return "insufficient-excitation" if _nothing_learned(ranking) else "adequate"
    enough = _removed(ranking, chosen) >= _enough(certain)
    return "unexplained" if left_over and not enough else "missing-physics"


def _enough(certain: bool) -> float:
    """Share of the removable squared error that a name has to remove."""
    return PARTLY if certain else REMOVED


def refused(ranking: Ranking, chosen: RankedFit, rows: Sequence[HeldoutRow]) -> bool:
    """Whether data that were not fitted refuse a name.

    Recordings that were kept back always may. A part left out of the fit may not where the name explains the whole: a
    free run that goes on for long can lose the motion for parameters that are a little off (a cog too far).
    """
    off = ranking.before.variance > DOUBTFUL
    explains = off and _removed(ranking, chosen) > REMOVED
    return hurts(rows) and not (explains and all(LEFT_OUT in r.recording for r in rows))


def _removed(ranking: Ranking, chosen: RankedFit) -> float:
    """Share of the removable squared error that is removed, of the signal where it is least.

    A free-running position is an integral: what merely stops its drift may leave the speed as wrong as before.
    """
    before, after = (_variances(ranking, h) for h in (ranking.nothing_missing, chosen))
    off = [s for s in before if before[s] > DOUBTFUL] or list(before)
    return min(1.0 - max(after[s] - 1.0, 0.0) / max(before[s] - 1.0, 1e-12) for s in off)


def whole(ranking: Ranking, chosen: RankedFit, *, certain: bool = False, another: bool = False) -> float:
    """How probable it is that what was found is the whole of what is missing, from the share that it leaves.

    A right name leaves noise; a cubic drag called quadratic leaves some per cent of the mismatch. It is half where as
    much is left as an unproved name may leave; a proved one halves once more where it would no longer be given.
    `another`: a law without a name is seen in it (other_law).
    """
    most = ANOTHER if another else 1.0
    if ranking.left.at_the_floor:
        return most
    left = 1.0 - _removed(ranking, chosen)
    alone = 1.0 / (1.0 + (left / (1.0 - REMOVED)) ** 2)
    beside = NEAREST / (1.0 + (left / (1.0 - PARTLY)) ** 2) if certain else 0.0
    return min(most, max(alone, beside))


def _above_noise(ranking: Ranking, h: RankedFit) -> float:
    """Mean squared errors of the signals, none less than its noise: what is gained below it is no gain."""
    return sum(max(v, 1.0) for v in _variances(ranking, h).values())


def _variances(ranking: Ranking, h: RankedFit) -> dict[str, float]:
    """Mean squared error of each signal in units of its noise."""
    problem = ranking.problem
    residuals = problem.residuals(h.fit.vector, h.fit.active)
    return {s: float(np.nanmean(r**2)) for s, r in join(problem, residuals).items()}


def verdict_without_a_name(ranking: Ranking) -> Verdict:
    """The verdict where data that were not fitted refuse every name."""
    return "adequate" if ranking.before.at_the_floor else "unexplained"


def _nothing_learned(ranking: Ranking) -> bool:
    this = ranking.nominal
    return excitation.learns_nothing(this.hypothesis, deviations(this, ranking.before), this.minimum.values)


def is_certain(rows: Sequence[HeldoutRow]) -> bool:
    """Whether recordings that were kept back prove a good part (PROVED) of the squared error removed, at the least."""
    kept_back = bool(rows) and not any(LEFT_OUT in r.recording for r in rows)
    return kept_back and removed_certainly(rows) > PROVED
