"""Simpler explanations than the best: fewer effects, and plain friction for its elaborations."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rwn.fit.budget import equal_shares
from rwn.fit.fit import Fitted
from rwn.fit.hypothesis import candidate, fit
from rwn.fit.secant import settled
from rwn.model.vocabulary import table
from rwn.name.screening import Search
from rwn.parallel import side_by_side

PLAIN = "coulomb-friction"  # what the other laws of dry friction elaborate


def with_simpler(search: Search, nominal: Fitted, fits: list[Fitted]) -> list[Fitted]:
    """The fits and simpler ones than the best; where one of these costs less, simpler ones than that too."""
    fits, best = distinct(fits), min([nominal, *fits], key=lambda f: f.cost)
    for _ in best.added[1:]:  # of which each time one at least is left out
        fits = distinct([*fits, *_simpler(search, best)])
        last, best = best, min([nominal, *fits], key=lambda f: f.cost)
        if len(best.added) >= len(last.added):
            break
    return fits


def _simpler(search: Search, best: Fitted) -> list[Fitted]:
    """The best explanation with each of several effects left out, and with plain friction for each of its elaborations.

    The search adds what gains most, so that it may never have met the plain law beside the second effect.
    """
    if len(best.added) < 2:
        return []
    sets = [best.added, *(tuple(n for n in best.added if n != name) for name in best.added)]
    plain = [tuple(sorted(plainer(names))) for names in sets]

    def less(pair: tuple[tuple[str, ...], float]) -> Fitted:
        names, share = pair
        starts = {n: best.values_of(n) if n in best.added else _plain_values(best) for n in names}
        this = candidate(search.nominal, names, search.scales, starts, best.motor)
        end = settled(search.problem, this, fit(search.problem, this, share=share), turns=1, share=share)
        return Fitted(added=names, candidate=this, minimum=end)

    others = list(dict.fromkeys([*sets[1:], *plain]))
    return side_by_side(less, zip(others, equal_shares(search.problem.work, len(others)), strict=True))


def _replaces(name: str) -> set[str]:
    """Nominal parameters that an effect takes over."""
    known = table().get(name)  # a user's own effect takes over nothing
    return {p.replaces for p in known.parameters if p.replaces} if known else set()


def replaced(fitted: Fitted) -> set[str]:
    """Nominal parameters that an explanation takes over."""
    return set().union(*map(_replaces, fitted.added))


def plainer(names: Sequence[str]) -> set[str]:
    """The same explanation with plain friction for its elaborations."""
    return {PLAIN if _replaces(n) and _replaces(n) == _replaces(PLAIN) else n for n in names}


def _plain_values(fitted: Fitted) -> dict[str, float]:
    """Plain friction of the level that the elaborate law of an explanation has."""
    (plain,) = (p for p in table()[PLAIN].parameters if p.replaces)
    levels = [
        value
        for name in fitted.added
        for p, value in zip(fitted.candidate.table[name].parameters, fitted.values_of(name).values(), strict=True)
        if p.replaces == plain.replaces
    ]
    return {plain.name: float(np.mean(levels))}


def distinct(fits: list[Fitted]) -> list[Fitted]:
    """Each set of effects once."""
    seen: dict[frozenset[str], Fitted] = {}
    for f in sorted(fits, key=lambda f: f.cost):
        seen.setdefault(frozenset(f.added), f)
    return list(seen.values())
