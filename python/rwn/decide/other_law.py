"""Whether another law is seen in what an explanation leaves: a few wavelets beside it, over each state.

A cubic drag called quadratic leaves a per cent of the mismatch. That may be as little as a right name leaves, but it is
a curve over speed, where a right name leaves noise.
"""

from __future__ import annotations

from dataclasses import dataclass

from rwn.fit.fit import Fit, fit
from rwn.fit.network import has_room, with_network
from rwn.fit.network_formula import PART, Place, places
from rwn.fit.part import look
from rwn.fit.problem import Problem
from rwn.fit.residuals import statistics
from rwn.model.model import Model
from rwn.parallel import side_by_side

ITERATIONS = 3
SEEN = 60.0  # gain in log-likelihood, in independent samples, of seven weights at the best of five places
MOST = 0.5  # share of the squared error above the noise that the curve has to explain


@dataclass(frozen=True, kw_only=True)
class Curve:
    """The wavelets that explain most of what is left, at the best of all places."""

    place: Place
    gained: float  # squared error per sample, in units of the noise
    seen: float  # the same as log-likelihood, in independent samples
    left: float  # squared error before

    @property
    def is_a_law(self) -> bool:
        """Whether it explains most of what is left above the noise, and by no chance."""
        return self.seen > SEEN and self.gained > MOST * (self.left - 1.0)


def curve_beside(problem: Problem, this: Fit, model: Model) -> Curve | None:
    """The best curve over one state beside a fit; None where the drive has no place for one."""
    if not has_room(model, 1, beside=len(this.added)):
        return None
    part = look(problem, this)
    left = statistics(part, this, drift=False)
    effects = {name: this.values_of(name) for name in this.added}

    def curve(place: Place) -> Curve:
        on, with_it = with_network(part, model, place, PART, motor=this.motor, effects=effects)
        after = statistics(on, fit(on, with_it, max_iterations=ITERATIONS), drift=False)
        gained = left.variance - after.variance
        seen = 0.5 * gained * left.count / (after.variance * after.correlation_time)
        return Curve(place=place, gained=gained, seen=seen, left=left.variance)

    return max(side_by_side(curve, places(problem, model)), key=lambda c: c.gained)
