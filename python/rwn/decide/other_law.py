"""Whether another law is seen: a curve over one state in some term, beside an explanation or in place of an effect.

A cubic drag called quadratic leaves a per cent of the mismatch. That may be as little as a right name leaves, but it is
a curve over speed, where a right name leaves noise.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import NamedTuple

from rwn.fit.budget import one_stage
from rwn.fit.fit import Fit, fit, refit
from rwn.fit.problem import Problem
from rwn.fit.residuals import Statistics, statistics
from rwn.fit.screening_part import screening_part
from rwn.model.model import Model
from rwn.parallel import side_by_side
from rwn.unnamed_law.law import has_room, with_network
from rwn.unnamed_law.network_formula import PART
from rwn.unnamed_law.place_screening import most_promising
from rwn.unnamed_law.places import Place, all_places

AT_FIRST = 2  # iterations of every curve: the weights are linear but for the motion that they change
FURTHER = 4  # iterations after the first, of the curves that leave least
GO_ON = 3  # curves that leave least
SHARES = 16  # of the work of a stage, for each curve
SEEN = 60.0  # gain in log-likelihood, in independent samples, of seven weights at the best of all places
MOST = 0.5  # share of the squared error above the noise that the curve has to explain


class _FittedCurve(NamedTuple):
    """The curve at a place, fitted in a problem that knows it."""

    place: Place
    on: Problem
    fit: Fit


@dataclass(frozen=True, kw_only=True)
class Curve:
    """The wavelets that explain most of what is left, at the best of all places."""

    place: Place
    gained: float  # squared error per sample, in units of the noise
    seen: float  # log-likelihood gained, in independent samples
    left: float  # squared error before

    @property
    def is_a_law(self) -> bool:
        """Whether it explains most of what is left above the noise, and by no chance."""
        return self.seen > SEEN and self.gained > MOST * (self.left - 1.0)


def curve_beside(problem: Problem, this: Fit, model: Model) -> Curve | None:
    """The best curve over one state beside a fit, of any term; None where the drive has no place for one."""
    if not has_room(model, 1, beside=len(this.added)):
        return None
    part = screening_part(problem, this)
    left = statistics(part, this, drift=False)
    place, after = _best_curve(part, model, this, {n: this.values_of(n) for n in this.added}, (this,))
    gained = left.variance - after.variance
    seen = 0.5 * gained * left.count / (after.variance * after.correlation_time)
    return Curve(place=place, gained=gained, seen=seen, left=left.variance)


def curve_instead(problem: Problem, this: Fit, without: Fit, model: Model) -> float:
    """Squared error with the best curve over one state in place of an effect, over that with the effect; at most 1.

    Where the effect is what acts, no curve over its state does better. The curve may be of any term, also a coefficient
    or the error of a sensor. 1 where the drive has no place for a curve. `without`: the fit by what the curve stands
    beside.
    """
    if not has_room(model, 1, beside=len(without.added)):
        return 1.0
    part = screening_part(problem, this)
    law = statistics(part, this, drift=False).variance
    effects = {n: (this if n in this.added else without).values_of(n) for n in without.added}
    _, best = _best_curve(part, model, this, effects, (without, this))
    return float(min(max(best.variance, 1.0) / max(law, 1.0), 1.0))


def _best_curve(
    part: Problem, model: Model, this: Fit, effects: Mapping[str, Mapping[str, float]], leaving: Sequence[Fit]
) -> tuple[Place, Statistics]:
    """The place whose curve leaves least beside `effects`, which begin at these values, and what it leaves.

    Fitted are those that promise most of what each of the fits `leaving` leaves.
    """
    share = one_stage(part.work) / SHARES

    def begun(place: Place) -> _FittedCurve:
        on, with_it = with_network(part, model, place, PART, motor=this.motor, effects=effects)
        return _FittedCurve(place, on, fit(on, this.carried_to(with_it), max_iterations=AT_FIRST, share=share))

    def gone_on(one: _FittedCurve) -> _FittedCurve:
        return one._replace(fit=refit(one.fit, one.on, iterations=FURTHER, share=share))

    found = all_places(part, model)
    tried = list(dict.fromkeys(chain.from_iterable(most_promising(part, one, found, PART) for one in leaving)))
    first = sorted(side_by_side(begun, tried), key=lambda one: one.fit.cost)
    left = [(one.place, statistics(one.on, one.fit, drift=False)) for one in side_by_side(gone_on, first[:GO_ON])]
    return min(left, key=lambda row: row[1].variance)
