"""Starts that race: what tells them apart, and which of them go on."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from rwn.fit.hypothesis import Candidate
from rwn.fit.levenberg_marquardt import DAMPING, Minimum
from rwn.fit.secant import rough

HOPELESS = 4.0  # cost in units of the best's, above which an explanation is refitted in passing
SIGHTED = 4  # starts that are worth an iteration where derivatives mislead from afar,
PHASES = 2  # and of each order of a periodic effect
MET = 1.0  # squared error in units of its variance, within which two starts have come to the same end


class Racer(NamedTuple):
    """A start of one effect; starts of different kinds (the first three) do not compete before they are fitted.

    Those of a drive's ends compete with the same first guess of the motor: a lag and a time constant of the motor that
    have changed places fit nearly as well, and lie next to a motor that the missing lag has bent.
    """

    name: str
    order: float  # periods per revolution; 0: not periodic
    begin: int  # 0 from the motor as the base has it, 1 from any other
    candidate: Candidate
    damping: float = DAMPING  # that its next leg begins with

    def after(self, m: Minimum) -> Racer:
        """The same where a leg ended; steps that were too long there are not tried again."""
        return self._replace(candidate=self.candidate.starting_at(m.values), damping=max(m.damping, DAMPING))


Row = tuple[Racer, Minimum]
Kind = tuple[str, float, int]


def misleads(racer: Racer) -> bool:
    """Whether the derivatives at a start may point away from the minimum."""
    bumpy = any(p.many_minima for p in racer.candidate.table[racer.name].parameters)
    return bool(racer.order or bumpy or rough(racer.candidate, racer.name))


def kind_of(racer: Racer) -> Kind:
    return racer.name, racer.order, racer.begin


def worth_an_iteration(ranked: Sequence[Racer]) -> list[Racer]:
    """Of starts whose derivatives mislead, by what they leave, least first, the foremost of each kind."""
    met: Counter[Kind] = Counter()
    kept = []
    for racer in ranked:
        met[kind_of(racer)] += 1
        if met[kind_of(racer)] <= (PHASES if racer.order else SIGHTED):
            kept.append(racer)
    return kept


def best_of_each(rows: Sequence[Row], keep: int, orders: int) -> list[Row]:
    """The `keep` best starts of each kind, of a periodic effect the best of each of its `orders` best orders."""
    groups: dict[Kind, list[Row]] = {}
    for row in sorted(rows, key=lambda row: row[1].cost):
        groups.setdefault(kind_of(row[0]), []).append(row)
    met: Counter[tuple[str, int]] = Counter()
    kept: list[Row] = []
    for (name, order, begin), group in groups.items():
        if not order:
            kept += group[:keep]
        elif met[name, begin] < orders:
            met[name, begin] += 1
            kept.append(group[0])
    return kept


def promising(rows: Sequence[Row], base_cost: float, least: int = 6, most: int = 8) -> list[Row]:
    """The rows of effects that have gained at least half of what the best has; at least `least`, at most `most`."""
    if not rows:
        return []
    costs: dict[str, float] = {}
    for racer, m in rows:
        costs[racer.name] = min(costs.get(racer.name, np.inf), m.cost)
    ranked = sorted(costs, key=lambda name: costs[name])
    bar = base_cost - 0.5 * max(base_cost - costs[ranked[0]], 0.0)
    kept = {name for k, name in enumerate(ranked[:most]) if k < least or costs[name] < bar}
    return [row for row in rows if row[0].name in kept]


def apart(rows: Sequence[Row], samples: int) -> list[Row]:
    """The rows without those that have met a better one of their effect; `samples`: that they were fitted to."""
    kept: list[Row] = []
    for row in sorted(rows, key=lambda row: row[1].cost):
        if not any(_met(row, better, samples) for better in kept):
            kept.append(row)
    return kept


def _met(row: Row, better: Row, samples: int) -> bool:
    """Whether a fit has come to the end of another: by its cost, and by the other's quadratic."""
    (racer, m), (other, end) = row, better
    little = MET * max(1.0, end.cost / samples)
    if racer.name != other.name or m.cost - end.cost > little:
        return False
    off = m.values - end.values
    return float(off @ end.information @ off) < little


def hopeless_from(rows: Sequence[Row], best: float) -> float:
    """The cost from which a row is hopeless."""
    return HOPELESS * min([best, *(m.cost for _, m in rows)])
