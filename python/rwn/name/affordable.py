"""Which effects are tried beside an explanation whose motion is far too fast for the rows."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rwn.fit.budget import left
from rwn.fit.fit import Fit, cost_of_a_step
from rwn.fit.problem import Problem

STEPS = 4  # simulations that an effect takes at least: two starts of two steps


def affordable(problem: Problem, base: Fit, names: Sequence[str], known: Sequence[Fit]) -> list[str]:
    """As many of `names` as what is left of the search pays for beside `base`, in their order.

    A fit takes a step whatever it costs, and one beside a bristle that bends within a row costs as much as a whole
    search. Those go first that explain most in the simplest of the explanations that are `known`.
    """
    count = int(left(problem.work) / (STEPS * max(cost_of_a_step(problem, base.hypothesis, base.vector), 1.0)))
    if count >= len(names):
        return list(names)
    best = dict[str, tuple[int, float]]()
    for this in known:
        for name in this.added:
            best[name] = min(best.get(name, (len(this.added), np.inf)), (len(this.added), this.cost))
    first = sorted(names, key=lambda name: best.get(name, (len(names), np.inf)))[:count]
    return [name for name in names if name in first]
