"""Further lines of a periodic effect: what its first line leaves may come back with the angle too.

They are no other effects, so an explanation with them has the same names.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rwn.fit.budget import affords_more, equal_shares
from rwn.fit.fit import Fit, fit
from rwn.fit.hypothesis import Hypothesis, first_unit, hypothesis
from rwn.fit.problem import Problem
from rwn.fit.residuals import statistics
from rwn.model.vocabulary import Effect
from rwn.name.initial_guesses import spectra
from rwn.name.initial_guesses.initial_angle import FAINT, sine_of
from rwn.name.observable import revolutions
from rwn.name.weights import log_odds
from rwn.parallel import side_by_side

LEADING = 3  # explanations, the best of which that has a periodic effect is asked for further lines
TRIED = 2  # orders that are tried for each line

Line = tuple[float, ...]  # the parameters of one line, in the order of those of the first


def with_further_lines(problem: Problem, fits: Sequence[Fit]) -> list[Fit]:
    """The fits, the best that has a periodic effect with all lines that are worth their parameters."""
    leading = sorted(fits, key=lambda f: f.cost)[:LEADING]
    first = next((f for f in leading if _periodic(f)), None)
    if first is None or statistics(problem, leading[0]).at_the_floor:
        return list(fits)
    this = first
    for name in _periodic(first):
        effect = problem.prior.table[name]
        this = _most_worth(problem, this, effect)
        while (less := _with_one_less(problem, this, effect)) is not None:
            this = less
    return [this if f is first else f for f in fits]


def _most_worth(problem: Problem, base: Fit, effect: Effect) -> Fit:
    """The explanation with as many lines as are worth most: one alone may be worth nothing while others are missing."""
    grown, done = [base], False
    while not done and affords_more(problem.work) and (more := _with_one_more(problem, grown[-1], effect)):
        grown.append(more)
        done = statistics(problem, more).at_the_floor
    worth = [_worth_of_lines(problem, more, base, k + 1) for k, more in enumerate(grown[1:])]
    return grown[1 + int(np.argmax(worth))] if worth and max(worth) > 0.0 else base


def _periodic(this: Fit) -> list[str]:
    """The added effects that may have further lines."""
    return [name for name in this.added if this.hypothesis.table[name].further]


def _with_one_more(problem: Problem, base: Fit, effect: Effect) -> Fit | None:
    """An explanation with one more line of an effect; None where there is no room for one, or none explains more."""
    if len(_lines(effect, base)) == 1 + max(p.line for p in effect.further):
        return None
    best = _best(problem, [_begun(problem, base, effect, order) for order in _orders(problem, base, effect)])
    return best if best is not None and best.cost < base.cost else None


def _with_one_less(problem: Problem, base: Fit, effect: Effect) -> Fit | None:
    """An explanation without the line that it does best without; None where each is worth its parameters."""
    lines = _lines(effect, base)
    if len(lines) == 1:
        return None
    others = [[*lines[:k], *lines[k + 1 :]] for k in range(len(lines))]
    best = _best(problem, [_with(problem, base, effect, kept) for kept in others])
    return best if best is not None and _worth_of_lines(problem, base, best) <= 0.0 else None


def _best(problem: Problem, begun: Sequence[Hypothesis]) -> Fit | None:
    if not begun:
        return None
    shares = equal_shares(problem.work, len(begun))
    found = side_by_side(lambda pair: fit(problem, pair[0], share=pair[1]), zip(begun, shares, strict=True))
    return min(found, key=lambda f: f.cost)


def _worth_of_lines(problem: Problem, more: Fit, less: Fit, count: int = 1) -> float:
    """Log odds of an explanation with `count` more lines, the order of each one of all that were looked at."""
    orders = spectra.order_grid(problem).size
    return log_odds(more, less, statistics(problem, more)) - count * float(np.log(orders))


def _orders(problem: Problem, base: Fit, effect: Effect) -> list[float]:
    """The orders that explain most of what an explanation leaves, other than those that are there.

    Poles and slots of a motor often differ by one. What leaks from one order to the next is that of less than a turn.
    """
    grid = spectra.order_grid(problem)
    step = float(grid[1] - grid[0])
    apart = min(spectra.NEIGHBOURS, spectra.NEIGHBOURS / (step * max(revolutions(problem), 1e-9)))
    (place,) = (k for k, p in enumerate(effect.parameters) if p.order)
    there = [line[place] for line in _lines(effect, base)]
    found = spectra.orders_left(problem, base, effect, TRIED + len(there), apart=apart)
    near = max(apart, 0.5) * step
    return [order for order in found if all(abs(order - known) > near for known in there)][:TRIED]


def _begun(problem: Problem, base: Fit, effect: Effect, order: float) -> Hypothesis:
    """An explanation with a line of an order, as strong and at the phase that explain most to first order."""
    (strength,) = (p for p in effect.parameters if p.strength)
    faint = FAINT * strength.start * first_unit(effect, strength, base.motor, problem.scales)
    lines = _lines(effect, base)

    def at(amplitude: float, phase: float) -> Hypothesis:
        one = tuple(order if p.order else phase if p.cyclic else amplitude for p in effect.parameters)
        return _with(problem, base, effect, [*lines, one])

    last = [p for p in effect.further if p.line == len(lines)]
    places = [effect.at(p.name) for p in (*(p for p in last if p.strength), *(p for p in last if p.cyclic))]
    normal = problem.normal(at(faint, 0.0).vector, base.active, places)
    return at(*sine_of(normal.gradient, normal.curvature, faint))


def _lines(effect: Effect, this: Fit) -> list[Line]:
    """The lines of an effect that act, the strongest first."""
    values = this.values_of(effect.name)
    acting = sorted({p.line for p in effect.acting(values)})
    lines = [tuple(values[p.name] for p in effect.every if p.line == number) for number in acting]
    (place,) = (k for k, p in enumerate(effect.parameters) if p.strength)
    return sorted(lines, key=lambda line: -line[place])


def _with(problem: Problem, base: Fit, effect: Effect, lines: Sequence[Line]) -> Hypothesis:
    """An explanation with these lines of an effect."""
    starts = base.starts(base.added)
    starts[effect.name] = {
        p.name: value
        for number, line in enumerate(lines)
        for p, value in zip((p for p in effect.every if p.line == number), line, strict=True)
    }
    return hypothesis(problem.prior, base.added, problem.scales, starts, base.motor)
