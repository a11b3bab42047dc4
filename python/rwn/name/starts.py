"""Starts of the fits of an effect: what tells them apart, and which of them go on (multi-start, successive halving)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import NamedTuple, TypeVar

import numpy as np

from rwn.fit.fit import FAR_BEHIND, Fit
from rwn.fit.hypothesis import Hypothesis, hypothesis
from rwn.fit.levenberg_marquardt import DAMPING
from rwn.fit.problem import Problem
from rwn.fit.screening_part import first_part
from rwn.name.first_order import FirstOrderCost
from rwn.name.initial_guesses.guess import Guess
from rwn.name.initial_guesses.guesses import initial_guesses
from rwn.name.initial_guesses.initial_angle import aligned, free_to_turn, without_phases

SAME_END = 1.0  # two starts have reached the same minimum within this squared distance, in units of its variance
REDUCED_INERTIA = 1.0 / 3.0  # of the inertia, in a start beside which a delay or a lag may take the place of the rest
MOVED = 0.5  # declared deviations by which a parameter may move while the motor counts as the one given


class Start(NamedTuple):
    """A start of one effect; starts of different kinds (the first three fields) do not compete before they are fitted.

    Those of a drive's ends compete with the same first guess of the motor: a lag and a time constant of the motor that
    have changed places fit nearly as well, and lie next to a motor that the missing lag has bent.
    """

    name: str
    order: float  # periods per revolution; 0: not periodic
    motor: int  # 0: begins from the motor as the base has it, 1: from any other
    hypothesis: Hypothesis
    damping: float = DAMPING  # that its next iterations begin with
    ended: Fit | None = None  # what it goes on from

    def after(self, this: Fit) -> Start:
        """The same where a fit ended; steps that were too long there are not tried again."""
        begun = self.hypothesis.starting_at(this.minimum.values)
        return self._replace(hypothesis=begun, damping=max(this.minimum.damping, DAMPING), ended=this)


class FittedStart(NamedTuple):
    """A start, moved to where its fit has come, and that fit."""

    start: Start
    fit: Fit

    @property
    def cost(self) -> float:
        """Weighted squared error and priors."""
        return self.fit.cost


class ScoredStart(NamedTuple):
    """A start, and what it leaves to first order."""

    start: Start
    cost: FirstOrderCost


Kind = tuple[str, float, int]
Tried = TypeVar("Tried", FittedStart, ScoredStart)


def starts(problem: Problem, base: Fit, name: str, *, orders: int) -> list[Start]:
    """The starts of `base` with the effect `name` added; `orders`: how many of a periodic effect."""
    effect = problem.prior.table[name]
    periodic = next((p.name for p in effect.parameters if p.order), "")
    known = base.starts(base.added)
    motors = [base.motor, *([{}] if _moved(base) else []), *problem.prior.starts]
    if effect.at_an_end:
        motors += _with_less_inertia(base)

    def begun(guess: Guess, motor: Mapping[str, float]) -> Hypothesis:
        this = hypothesis(problem.prior, (*base.added, name), problem.scales, {**known, name: guess}, motor)
        return aligned(on, this, effect) if turned else this

    turned = free_to_turn(problem, base, effect)
    on = first_part(problem, base) if turned else problem
    guesses = initial_guesses(problem, base, effect, count=orders)
    return [
        Start(name, guess.get(periodic, 0.0), min(k, 1) if effect.at_an_end else 0, begun(guess, motor))
        for guess in (without_phases(guesses, effect) if turned else guesses)
        for k, motor in enumerate(motors)
    ]


def _moved(base: Fit) -> bool:
    """Whether a fit has moved the motor far: what is missing may have bent it, so the given motor is a start too."""
    return any(
        u.prior is not None and u.prior > 0.0 and abs(v - u.prior) > MOVED * u.prior_std * u.prior
        for u, v in zip(base.hypothesis.unknowns, base.minimum.values, strict=True)
    )


def _with_less_inertia(base: Fit) -> list[dict[str, float]]:
    """The motor with less inertia: a larger one may have taken up a delay, beside which the delay would not show."""
    uncertain = {u.name for u in base.hypothesis.unknowns}
    if "inertia" not in uncertain:
        return []
    return [{**base.motor, "inertia": REDUCED_INERTIA * base.motor["inertia"]}]


def kind_of(start: Start) -> Kind:
    """What it competes within."""
    return start.name, start.order, start.motor


def best_of_each(attempts: Sequence[Tried], keep: int, orders: int) -> list[Tried]:
    """The `keep` best starts of each kind, of a periodic effect the best of each of its `orders` best orders."""
    groups: dict[Kind, list[Tried]] = {}
    for attempt in sorted(attempts, key=lambda a: a.cost):
        groups.setdefault(kind_of(attempt.start), []).append(attempt)
    met: Counter[tuple[str, int]] = Counter()
    kept: list[Tried] = []
    for (name, order, motor), group in groups.items():
        if not order:
            kept += group[:keep]
        elif met[name, motor] < orders:
            met[name, motor] += 1
            kept.append(group[0])
    return kept


def promising(attempts: Sequence[FittedStart], base_cost: float, least: int = 6, most: int = 8) -> list[FittedStart]:
    """Those of effects that have gained at least half of what the best has; at least `least`, at most `most`."""
    if not attempts:
        return []
    costs: dict[str, float] = {}
    for start, fit in attempts:
        costs[start.name] = min(costs.get(start.name, np.inf), fit.cost)
    ranked = sorted(costs, key=lambda name: costs[name])
    bar = base_cost - 0.5 * max(base_cost - costs[ranked[0]], 0.0)
    kept = {name for k, name in enumerate(ranked[:most]) if k < least or costs[name] < bar}
    return [a for a in attempts if a.start.name in kept]


def distinct_ends(attempts: Sequence[FittedStart], samples: int) -> list[FittedStart]:
    """Those that have not come to the end of a better one of their effect; `samples`: that they were fitted to."""
    kept: list[FittedStart] = []
    for attempt in sorted(attempts, key=lambda a: a.cost):
        if not any(_same_end(attempt, better, samples) for better in kept):
            kept.append(attempt)
    return kept


def _same_end(attempt: FittedStart, better: FittedStart, samples: int) -> bool:
    """Whether a fit has come to the end of another: by its cost, and by the other's quadratic."""
    end = better.fit.minimum
    little = SAME_END * max(1.0, end.cost / samples)
    if attempt.start.name != better.start.name or attempt.cost - end.cost > little:
        return False
    off = attempt.fit.minimum.values - end.values
    return float(off @ end.information @ off) < little


def far_behind(attempts: Sequence[FittedStart], best: float) -> float:
    """The cost from which an attempt is far behind the best, which costs no more than `best`."""
    return FAR_BEHIND * min([best, *(a.cost for a in attempts)])
