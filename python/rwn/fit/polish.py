"""More turns for the best fits where the error is rough."""

from __future__ import annotations

from dataclasses import replace

from rwn.fit.budget import shares_by_rank
from rwn.fit.fit import Fitted
from rwn.fit.levenberg_marquardt import Minimum
from rwn.fit.secant import rough, settled
from rwn.name.screening import Search
from rwn.parallel import side_by_side

TURNS = 3
RIVAL = 2.0  # cost in units of the best, up to which a fit may still turn out to be better


def polished(search: Search, nominal: Fitted, fits: list[Fitted]) -> tuple[Search, Fitted, list[Fitted]]:
    """The same fits, those that may be the best fitted on by `rough.settled`."""
    bar = RIVAL * min(f.cost for f in (nominal, *fits))
    worth = [f for f in fits if f.cost < bar and rough(f.candidate)]
    shares = shares_by_rank(search.problem.work, [f.cost for f in worth])

    def on(pair: tuple[Fitted, float]) -> Minimum:
        f, share = pair
        return settled(search.problem, f.candidate, f.minimum, turns=TURNS, share=share)

    ends = side_by_side(on, zip(worth, shares, strict=True))
    better = {id(f): replace(f, minimum=m) for f, m in zip(worth, ends, strict=True)}
    return search, nominal, [better.get(id(f), f) for f in fits]
