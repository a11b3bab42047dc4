"""Screens every effect that might be missing: many starts, few iterations each, the promising ones to the end.

The starts of an effect are told apart before they are fitted (`first_order`); then successive halving: after every
round, on more samples than the last, the better ones go on.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from functools import partial

import numpy as np

from rwn.fit.budget import shares_by_rank, shares_of_steps
from rwn.fit.fit import BRIEFLY, TO_THE_END, Fit, cost_of_a_step, fit, refit
from rwn.fit.levenberg_marquardt import FitStatus
from rwn.fit.problem import Problem
from rwn.fit.residuals import statistics
from rwn.fit.screening_part import first_part, screening_part
from rwn.fit.secant import down_secants
from rwn.name.first_order import FirstOrder
from rwn.name.starts import (
    FittedStart,
    ScoredStart,
    Start,
    best_of_each,
    distinct_ends,
    far_behind,
    kind_of,
    promising,
    starts,
)
from rwn.parallel import side_by_side

RESOLUTION = 0.1  # changes of the cost below this decide nothing between explanations
ITERATIONS = 4  # iterations of every start in the first round, which is made on the screening part
FURTHER = 6  # iterations after the first round, before the promising ones are chosen
NO_GAIN = 0.98  # cost, as a share of the base's, above which a start with a non-smooth error has gained nothing
STEEP = 0.5  # a fit goes on, whatever the others have, while a round leaves at most this share of its first cost
OF_THE_MACHINE = 3  # most effects of the machine itself in one explanation, as in every set of trials


def screen(
    problem: Problem, base: Fit, names: Iterable[str], *, keep: int = 2, best: float = np.inf, patience: int = 1
) -> list[Fit]:
    """`base` with each of `names` added, fitted from several starts; best first.

    `best`: least cost of other explanations by as many effects; what comes nowhere near it is fitted briefly.
    `patience`: how many times the usual iterations a start gets before it is given up.
    """
    fitting = [n for n in names if n not in base.hypothesis.effects and _has_room(base, n)]
    begun = side_by_side(lambda name: starts(problem, base, name, orders=keep + 1), fitting)
    on = screening_part(problem, base)
    chosen = _chosen(problem, base, [start for of_one in begun for start in of_one], keep)
    attempts = _round(chosen, iterations=ITERATIONS * patience, on=on, problem=problem)
    here = base.cost if on is problem else refit(base, on).cost
    best_here = best * here / base.cost if np.isfinite(best) else best
    attempts = _further(problem, best_of_each(attempts, keep, orders=keep), on, best_here)
    attempts = distinct_ends(promising(attempts, here), on.samples)
    near = _down_secants(attempts, on, here, best_here)
    ends = _given_up(problem, _to_the_end(problem, near, on, best_here=best_here, best=best))
    best_of: dict[tuple[str, ...], Fit] = {}
    for end in sorted(ends, key=lambda end: end.cost):
        best_of.setdefault(end.fit.added, end.fit)
    return list(best_of.values())


def _chosen(problem: Problem, base: Fit, these: Sequence[Start], keep: int) -> list[Start]:
    """The `keep` starts of each kind that leave least to first order, of a periodic effect that of each best order."""
    counts = Counter(map(kind_of, these))
    competing = [s for s in these if counts[kind_of(s)] > keep]
    if not competing:
        return list(these)
    first_order = FirstOrder(first_part(problem, base), base)
    left = side_by_side(lambda start: first_order.left_by(start.hypothesis), competing)
    best = best_of_each([ScoredStart(*pair) for pair in zip(competing, left, strict=True)], keep, orders=keep + 1)
    return [*(s for s in these if counts[kind_of(s)] <= keep), *(one.start for one in best)]


def _round(these: Sequence[Start], *, iterations: int, on: Problem, problem: Problem) -> list[FittedStart]:
    """Some iterations of every start; each attempt holds the start of the next round where this one ended."""
    costs = side_by_side(lambda s: cost_of_a_step(on, s.hypothesis), these)
    shares = shares_of_steps(problem.work, costs)
    return side_by_side(
        lambda pair: _attempt(pair[0], iterations, on, share=pair[1], roughly=True), zip(these, shares, strict=True)
    )


def _attempt(start: Start, iterations: int, on: Problem, *, share: float, roughly: bool = False) -> FittedStart:
    end = fit(
        on, start.hypothesis, max_iterations=iterations, tolerance=RESOLUTION, damping=start.damping, share=share,
        roughly=roughly, ended=start.ended,
    )  # fmt: skip
    return FittedStart(start.after(end), end)


def _further(problem: Problem, attempts: Sequence[FittedStart], on: Problem, best_here: float) -> list[FittedStart]:
    """Goes on with the fits that have not converged: their first iterations say little of where they end.

    Once one leaves nothing but noise, only those go on that are not far behind it.
    """
    leading = min(attempts, key=lambda a: a.cost, default=None)
    explained = leading is not None and statistics(on, leading.fit).at_the_floor
    bar = far_behind(attempts, best_here)
    again = [_under_way(a.fit) and (not explained or _goes_on(a.fit, bar)) for a in attempts]
    begun = [a.start for a, yes in zip(attempts, again, strict=True) if yes]
    ends = iter(_round(begun, iterations=FURTHER, on=on, problem=problem))
    return [next(ends) if yes else a for a, yes in zip(attempts, again, strict=True)]


def _to_the_end(
    problem: Problem, attempts: Sequence[FittedStart], on: Problem, *, best_here: float, best: float
) -> list[FittedStart]:
    """Every start fitted to all recordings, until it converges or, where it is far behind and gains little, briefly.

    `attempts`: how far they came on the screening part `on`. `best_here`, `best`: the least costs that are known on it
    and on all recordings.
    """
    by_rank = partial(_by_rank, problem)
    bar = far_behind(attempts, best_here)

    def on_all(attempt: FittedStart, share: float) -> FittedStart:
        if on is problem and not _under_way(attempt.fit):
            return attempt
        iterations = TO_THE_END if _goes_on(attempt.fit, bar) else BRIEFLY
        return _attempt(attempt.start, iterations, problem, share=share)

    attempts = by_rank(on_all, attempts)
    bar = far_behind(attempts, best)

    def unfinished(attempt: FittedStart, share: float) -> FittedStart:
        brief = _under_way(attempt.fit) and attempt.fit.minimum.iterations <= BRIEFLY
        if brief and _goes_on(attempt.fit, bar):
            return _attempt(attempt.start, TO_THE_END, problem, share=share)
        return attempt

    return by_rank(unfinished, attempts)


def _given_up(problem: Problem, ends: list[FittedStart]) -> list[FittedStart]:
    """Goes on with fits given up for being far behind, where what was ahead of them leaves more than noise."""
    best = min(ends, key=lambda end: end.cost, default=None)
    if best is None or statistics(problem, best.fit).at_the_floor:
        return ends

    def to_the_end(attempt: FittedStart, share: float) -> FittedStart:
        return _attempt(attempt.start, TO_THE_END, problem, share=share) if _under_way(attempt.fit) else attempt

    return _by_rank(problem, to_the_end, ends)


def _by_rank(
    problem: Problem, go_on: Callable[[FittedStart, float], FittedStart], attempts: Sequence[FittedStart]
) -> list[FittedStart]:
    """`go_on` of every attempt, which may cost the more the better the attempt is."""
    shares = shares_by_rank(problem.work, [a.cost for a in attempts])
    return side_by_side(lambda pair: go_on(*pair), zip(attempts, shares, strict=True))


def _down_secants(attempts: Sequence[FittedStart], on: Problem, base_cost: float, best: float) -> list[FittedStart]:
    """Starts with a non-smooth error, that have gained something and are not far behind, brought near their minimum."""
    bar = min(NO_GAIN * base_cost, max(far_behind(attempts, best), STEEP * base_cost))

    def near(attempt: FittedStart, share: float) -> FittedStart:
        start, this = attempt
        if this.cost < bar:
            at = Fit(hypothesis=start.hypothesis, minimum=this.minimum)
            this = down_secants(on, at, turns=1, share=share)
        return FittedStart(start.after(this), this)

    return _by_rank(on, near, attempts)


def _has_room(base: Fit, name: str) -> bool:
    """One effect at most can bring a second mass; of the machine itself `OF_THE_MACHINE` at most are added."""
    table = base.hypothesis.table
    masses = sum(table[n].second_mass for n in (*base.hypothesis.effects, name))
    return masses <= 1 and sum(not table[n].at_an_end for n in (*base.added, name)) <= OF_THE_MACHINE


def _goes_on(this: Fit, bar: float) -> bool:
    """Whether a fit is not far behind, or has gained much of late."""
    return this.cost < max(bar, STEEP * this.minimum.first)


def _under_way(this: Fit) -> bool:
    return this.minimum.status is FitStatus.ITERATION_LIMIT
