"""What the search for an explanation may cost, counted in the core: the same on every machine and in every run.

A stage of the search may take a tenth of what is left, so that no budget is ever used up; where little is left, what
is tried beside the most promising is not. Each number of effects at once has a budget of its own, and so has a search
that begins anew under another measurement: what was tried before decides nothing about what is tried.
"""

from __future__ import annotations

import numpy as np

from rwn import _core

TOTAL = 13e9  # work of a usual search by so many effects: 16 s of one core of 2026, 10 s of two
STAGE = 0.1  # share of the work that is left, for the fits of a stage together
LEAST = 0.1  # share of TOTAL that counts as left at least
RESERVE = 0.3  # share of TOTAL that is left for what is promising rather than spent on what has not been tried


def meter(effort: float = 1.0) -> _core.Work:
    """A meter of a search that may cost `effort` times the usual total: the rest is credited to it beforehand."""
    work = _core.Work()
    work.add(round((1.0 - effort) * TOTAL))
    return work


def renew(work: _core.Work, begun: int) -> None:
    """Sets a meter back to what it had counted when a search began."""
    work.add(begun - work.done)


def left(work: _core.Work) -> float:
    """What is left of the total."""
    return max(TOTAL - work.done, LEAST * TOTAL)


def affords_more(work: _core.Work) -> bool:
    """Whether what has not been tried may be tried."""
    return left(work) > RESERVE * TOTAL


def one_stage(work: _core.Work) -> float:
    """What a fit may cost that is a stage by itself."""
    return STAGE * left(work)


def first_stage() -> float:
    """What a stage may cost of which nothing has been spent: comparisons made early and late are alike."""
    return STAGE * TOTAL


def equal_shares(work: _core.Work, count: int) -> list[float]:
    """What each of `count` fits may cost where none is more promising than another."""
    return [one_stage(work) / max(count, 1)] * count


def shares_of_steps(work: _core.Work, costs: list[float]) -> list[float]:
    """What fits may cost that are to come equally far, given what a step of each costs."""
    total = max(sum(costs), 1.0)
    return [one_stage(work) * cost / total for cost in costs]


def shares_by_rank(work: _core.Work, costs: list[float]) -> list[float]:
    """What each fit may cost, given how far each is from an explanation: the second best half as much as the best."""
    rank = np.argsort(np.argsort(costs, kind="stable"), kind="stable")
    weights = 1.0 / (1.0 + rank)
    return [float(w) for w in one_stage(work) * weights / max(weights.sum(), 1.0)]
