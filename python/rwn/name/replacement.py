"""Sequential replacement (Miller 2002, Subset Selection in Regression, ch. 3): a plainer effect in the place of one.

Forward selection adds what gains most, so that it may never have met a plain effect beside the others of the best
explanation. What was found with more parameters in its place would be held to be the law.
"""

from __future__ import annotations

from collections.abc import Sequence

from rwn.fit.budget import affords_more, one_stage, renew
from rwn.fit.fit import Fit
from rwn.fit.problem import Problem
from rwn.fit.refitting import fitted_without
from rwn.name.affordable import affordable
from rwn.name.backward import distinct, price
from rwn.name.screening import screen


def with_plainer_instead(problem: Problem, fits: list[Fit], wanted: Sequence[str], *, begun: int) -> list[Fit]:
    """The fits, and the best of several effects with one of fewer parameters, among `wanted`, in the place of each.

    `begun`: what the meter had counted when the search began; this has a budget of its own.
    """
    best = min(fits, key=lambda f: price(problem, f), default=None)
    if best is None or len(best.added) < 2:
        return fits
    renew(problem.work, begun)
    found = list(fits)
    for name in best.added:
        fewer = [n for n in wanted if n not in best.added and _size(best, n) < _size(best, name)]
        if fewer and affords_more(problem.work):
            rest = fitted_without(problem, best, name, fits, share=one_stage(problem.work))
            found += screen(problem, rest, affordable(problem, rest, fewer, fits), keep=1, best=best.cost)
    return distinct(found)


def _size(this: Fit, name: str) -> int:
    """Parameters of an effect that are not known from its law."""
    return sum(not p.idealised for p in this.hypothesis.table[name].parameters)
