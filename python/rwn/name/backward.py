"""Backward elimination: simpler explanations than the best, with fewer effects or with plain friction."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache

import numpy as np

from rwn.fit.budget import equal_shares
from rwn.fit.fit import Fit, fit
from rwn.fit.hypothesis import hypothesis
from rwn.fit.problem import Problem
from rwn.fit.secant import down_secants
from rwn.model.vocabulary import table
from rwn.parallel import side_by_side


def with_simpler(problem: Problem, nominal: Fit, fits: list[Fit]) -> list[Fit]:
    """The fits and simpler ones than the best; where one of these is better, simpler ones than that too.

    The best has the least price: of two that leave noise alone the simpler one.
    """
    fits, best = distinct(fits), min([nominal, *fits], key=lambda f: price(problem, f))
    for _ in best.added:  # of which each time one at least is left out or made plainer
        fits = distinct([*fits, *_simpler(problem, best)])
        last, best = best, min([nominal, *fits], key=lambda f: price(problem, f))
        if len(best.added) >= len(last.added):
            break
    return fits


def price(problem: Problem, this: Fit) -> float:
    """Its cost with what its unknowns count by BIC."""
    return this.cost + this.unknowns_seen * float(np.log(problem.samples))


def _simpler(problem: Problem, best: Fit) -> list[Fit]:
    """The best explanation with each of several effects left out, and with one of its elaborations or all made plain.

    The search adds what gains most, so that it may never have met the plain law beside the second effect.
    """
    if len(best.added) < 2 and plainer(best.added) == set(best.added):
        return []
    sets = [best.added, *(tuple(n for n in best.added if n != name) for name in best.added)]
    one_plainer = [({*best.added} - {name}) | plainer([name]) for name in best.added]
    plain = [tuple(sorted(names)) for names in (*one_plainer, *map(plainer, sets))]

    def less(pair: tuple[tuple[str, ...], float]) -> Fit:
        names, share = pair
        starts = best.starts(n for n in names if n in best.added)
        starts |= {n: _plain_values(best, n) for n in plain_laws().values() if n in names and n not in starts}
        for general in best.added:
            if _special(general) != general and _special(general) in names:
                starts[_special(general)] = table()[general].as_special_case(best.values_of(general))
        this = hypothesis(problem.prior, names, problem.scales, starts, best.motor)
        return down_secants(problem, fit(problem, this, share=share), turns=1, share=share)

    others = [names for names in dict.fromkeys([*sets[1:], *plain]) if names and set(names) != set(best.added)]
    return side_by_side(less, zip(others, equal_shares(problem.work, len(others)), strict=True))


def _special(name: str) -> str:
    """The special case of an effect; the effect itself where it has none, as a user's own."""
    known = table().get(name)
    return (known.special_case if known else "") or name


def _replaces(name: str) -> set[str]:
    """Nominal parameters that an effect takes over."""
    known = table().get(name)  # a user's own effect takes over nothing
    return {p.replaces for p in known.parameters if p.replaces} if known else set()


def replaced(this: Fit) -> set[str]:
    """Nominal parameters that an explanation takes over."""
    return set().union(*map(_replaces, this.added))


@cache
def plain_laws() -> Mapping[frozenset[str], str]:
    """Nominal parameters -> the effect that is nothing but one of them: what others that take it over elaborate."""
    return {frozenset(_replaces(n)): n for n, e in table().items() if len(e.parameters) == 1 and _replaces(n)}


def plainer(names: Sequence[str]) -> set[str]:
    """The same explanation with plain friction for its elaborations, and special cases for what generalises them."""
    return {plain_laws().get(frozenset(_replaces(n))) or _special(n) for n in names}


def elaborations() -> list[str]:
    """The laws that say more than a plainer one: of friction than that it is dry, or with a power of their own."""
    return [n for n in table() if plainer([n]) != {n}]


def family(name: str) -> set[str]:
    """The law and those that are the same made plain: dry friction of any kind, a load with and without a spring."""
    return {name} | {n for n in table() if plainer([n]) == plainer([name])}


def _plain_values(this: Fit, name: str) -> dict[str, float]:
    """A plain law, as friction, of the level that the elaborate one of an explanation has."""
    (plain,) = table()[name].parameters
    levels = [
        this.values_of(name)[p.name]
        for name in this.added
        for p in this.hypothesis.table[name].parameters
        if p.replaces == plain.replaces
    ]
    return {plain.name: float(np.mean(levels))}


def distinct(fits: Sequence[Fit]) -> list[Fit]:
    """Each set of effects once."""
    seen: dict[frozenset[str], Fit] = {}
    for f in sorted(fits, key=lambda f: f.cost):
        seen.setdefault(frozenset(f.added), f)
    return list(seen.values())
