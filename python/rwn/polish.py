"""Further starts of the best fit where the error is rough: a contact met a little earlier changes all that follows."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from rwn.candidate import Candidate, fit
from rwn.search import Fitted, Search
from rwn.threads import side_by_side

FACTORS = (0.8, 1.3)
ROUNDS = 5
ITERATIONS = 12
GAIN = 2e-3  # least relative gain in cost that is worth another round


def polished(search: Search, nominal: Fitted, fits: list[Fitted]) -> tuple[Search, Fitted, list[Fitted]]:
    """The same fits, the best one started again from other values of the parameters that idealise it."""
    best = min([nominal, *fits], key=lambda f: f.cost)
    first = best
    for _ in range(ROUNDS):
        ends = side_by_side(
            lambda c: fit(search.problem, c, max_iterations=ITERATIONS), _neighbours(best), jobs=search.jobs
        )
        again = min(ends, key=lambda m: m.cost, default=best.minimum)
        if again.cost > (1.0 - GAIN) * best.cost:
            break
        best = replace(best, minimum=again)
    return search, nominal, [best if f is first else f for f in fits]


def _neighbours(best: Fitted) -> Iterator[Candidate]:
    idealised = {
        f"{name}.{p.name}" for name in best.added for p in best.candidate.table[name].parameters if p.idealised
    }
    for k, unknown in enumerate(best.candidate.unknowns):
        if unknown.name not in idealised:
            continue
        for factor in FACTORS:
            values = best.minimum.values.copy()
            values[k] = np.clip(factor * values[k], unknown.lower, unknown.upper)
            yield best.candidate.starting_at(values)
