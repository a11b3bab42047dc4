"""Sequential replacement (Miller 2002, Subset Selection in Regression, ch. 3): a plainer effect in the place of one.

Forward selection adds what gains most, so that it may never have met a plain effect beside the others of the best
explanation. What was found with more parameters in its place would be held to be the law.
"""

from __future__ import annotations

from collections.abc import Sequence

from rwn.fit.budget import affords_more, one_stage, renew
from rwn.fit.fit import Fit, fit
from rwn.fit.hypothesis import hypothesis
from rwn.fit.problem import Problem
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
            found += screen(problem, _without(problem, fits, best, name), fewer, keep=1, best=best.cost)
    return distinct(found)


def _size(this: Fit, name: str) -> int:
    """Parameters of an effect that are not known from its law."""
    return sum(not p.idealised for p in this.hypothesis.table[name].parameters)


def _without(problem: Problem, fits: Sequence[Fit], best: Fit, name: str) -> Fit:
    """The best explanation without one of its effects: as it is known, or fitted from where that ended."""
    rest = tuple(n for n in best.added if n != name)
    known = next((f for f in fits if set(f.added) == set(rest)), None)
    if known is not None:
        return known
    begun = hypothesis(problem.prior, rest, problem.scales, best.starts(rest), best.motor)
    return fit(problem, begun, share=one_stage(problem.work))
