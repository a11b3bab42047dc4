"""Whether another law than the named one is seen in what the name leaves: a few wavelets beside it, over each state.

A cubic drag called quadratic leaves a per cent of the mismatch. That may be as little as a right name leaves, but it is
a curve over speed, where a right name leaves noise.
"""

from __future__ import annotations

from dataclasses import replace

from rwn.correct.network import has_room, with_network
from rwn.correct.network_formula import PART, Place, places
from rwn.fit import residuals as evidence
from rwn.fit.fit import Fitted
from rwn.fit.hypothesis import fit
from rwn.fit.residuals import AT_THE_FLOOR, Hypothesis
from rwn.model.model import Model
from rwn.name.forward import Explanation
from rwn.name.screening import Search
from rwn.parallel import side_by_side

ITERATIONS = 3
SEEN = 60.0  # gain in log-likelihood, in independent samples, of seven weights at the best of five places
MOST = 0.5  # share of the squared error above the noise that the curve has to explain


def another_law(found: Explanation, chosen: Hypothesis, model: Model) -> Place | None:
    """Where a law beside `chosen` explains most of what it leaves; None where it leaves noise or nothing so plain."""
    named = chosen.fitted
    search = Search.of(found.setup)
    coloured = evidence.statistics(search.problem, named, drift=False).coloured >= AT_THE_FLOOR
    if not coloured or not has_room(model, 1, beside=len(named.added)):
        return None
    part = replace(found.setup, problem=search.look(named))
    left = evidence.statistics(part.problem, named, drift=False)
    effects = {name: named.values_of(name) for name in named.added}

    def gain(place: Place) -> float:
        setup, this = with_network(part, model, place, PART, motor=named.motor, effects=effects)
        end = Fitted(added=named.added, candidate=this, minimum=fit(setup.problem, this, max_iterations=ITERATIONS))
        after = evidence.statistics(setup.problem, end, drift=False)
        gained = left.variance - after.variance
        seen = 0.5 * gained * left.count / (after.variance * after.correlation_time)
        return gained if seen > SEEN and gained > MOST * (left.variance - 1.0) else 0.0

    tried = places(found.setup, model)
    gained, best = max(zip(side_by_side(gain, tried), range(len(tried)), strict=True))
    return tried[best] if gained > 0.0 else None
