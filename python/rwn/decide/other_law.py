"""Whether another law than the named one is seen in what the name leaves: a few wavelets beside it, over each state.

A cubic drag called quadratic leaves a per cent of the mismatch. That may be as little as a right name leaves, but it is
a curve over speed, where a right name leaves noise.
"""

from __future__ import annotations

from rwn.fit.fit import fit
from rwn.fit.network import has_room, with_network
from rwn.fit.network_formula import PART, Place, places
from rwn.fit.part import look
from rwn.fit.residuals import MOST_COLOURED, statistics
from rwn.model.model import Model
from rwn.name.ranking import Ranking
from rwn.name.weights import RankedFit
from rwn.parallel import side_by_side

ITERATIONS = 3
SEEN = 60.0  # gain in log-likelihood, in independent samples, of seven weights at the best of five places
MOST = 0.5  # share of the squared error above the noise that the curve has to explain


def other_law(ranking: Ranking, chosen: RankedFit, model: Model) -> Place | None:
    """Where a law beside `chosen` explains most of what it leaves; None where it leaves noise or nothing so plain."""
    named, problem = chosen.fit, ranking.problem
    coloured = statistics(problem, named, drift=False).coloured >= MOST_COLOURED
    if not coloured or not has_room(model, 1, beside=len(named.added)):
        return None
    part = look(problem, named)
    left = statistics(part, named, drift=False)
    effects = {name: named.values_of(name) for name in named.added}

    def gain(place: Place) -> float:
        on, this = with_network(part, model, place, PART, motor=named.motor, effects=effects)
        after = statistics(on, fit(on, this, max_iterations=ITERATIONS), drift=False)
        gained = left.variance - after.variance
        seen = 0.5 * gained * left.count / (after.variance * after.correlation_time)
        return gained if seen > SEEN and gained > MOST * (left.variance - 1.0) else 0.0

    tried = places(problem, model)
    gained, best = max(zip(side_by_side(gain, tried), range(len(tried)), strict=True))
    return tried[best] if gained > 0.0 else None
