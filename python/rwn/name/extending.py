"""Explanations with one effect more: what helps beside the best that were found, in free run and in short windows."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rwn.fit.budget import affords_more, one_stage
from rwn.fit.fit import Fit, fit, refit
from rwn.fit.hypothesis import hypothesis
from rwn.fit.prior_weight import with_priors_weighed
from rwn.fit.problem import Problem
from rwn.fit.residual_noise import with_noise_of
from rwn.fit.residuals import statistics
from rwn.name.affordable import affordable
from rwn.name.backward import distinct, plain_laws, replaced
from rwn.name.multiple_shooting import fitted_in_windows, fitted_to_free_run, has_lost_the_motion, is_far_off
from rwn.name.not_tried import NotTried
from rwn.name.ranking import Extensions, Fits
from rwn.name.screening import screen


def beside_and_in_windows(
    alone: Fits, best: Fit, bases: Sequence[Fit], wanted: Sequence[str], fits: Sequence[Fit], known: Extensions, *,
    size: int, windowed: Sequence[Fit], thorough: int = 1,
) -> tuple[Extensions, Sequence[Fit]]:  # fmt: skip
    """What helps beside `bases`, with what is found in short windows where a free run is far off.

    In windows first once free run has lost the motion, since it finds nothing then and would use up what a search may
    cost; else where free run has found nothing near. Returned with it is all that was found in windows, before too.
    """
    problem, more = alone.problem, list[Fit]()
    lost = has_lost_the_motion(problem, best)
    if lost:
        more = fitted_in_windows(problem, alone.nominal_fit, wanted, size, windowed)
    found = beside(problem, bases, wanted, fits, known, thorough=thorough)
    closest = min([best, *found.fits], key=lambda f: f.cost)
    if not lost and affords_more(problem.work) and is_far_off(problem, closest):
        more = fitted_in_windows(problem, alone.nominal_fit, wanted, size, windowed)
    return found._replace(fits=distinct([*found.fits, *fitted_to_free_run(more, problem)])), [*windowed, *more]


def beside(
    problem: Problem, bases: Sequence[Fit], wanted: Sequence[str], fits: Sequence[Fit], known: Extensions, *,
    thorough: int = 1,
) -> Extensions:  # fmt: skip
    """What helps beside each of `bases`: any effect beside the first `thorough`, promising ones beside the others.

    Once the best found leaves noise alone, one that has no part in it is tried beside its parts: it may rival one.
    """
    found, tried, names = [f for f in known.fits if made_of(f, wanted)], known.tried, list(wanted)
    left = list[NotTried]()
    for place, base in enumerate(bases):
        parts = _complete_explanation(problem, found)
        rivals = bool(parts) and not parts & set(base.added)
        here = [n for n in names if n in parts] if rivals else names
        untried = [name for name in here if (base.added, name) not in tried]
        skip = (place or known.fits) and not rivals and not affords_more(problem.work)
        new = [] if skip else affordable(problem, base, untried, fits)
        if skipped := tuple(name for name in untried if name not in (*new, *base.added)):
            left.append(NotTried(beside=base.added, effects=skipped))
        if skip:
            continue
        found += screen(problem, base, new, keep=1, best=min((f.cost for f in found), default=np.inf))
        tried |= {(base.added, name) for name in new}
        if place + 1 >= thorough:
            met = {name for f in (*fits, *found) for name in f.added}
            names = [name for name in wanted if name in met]
    return Extensions(distinct(found), tried, tuple(left))


def _complete_explanation(problem: Problem, found: Sequence[Fit]) -> frozenset[str]:
    """The effects of the best that was found if it leaves but noise; none otherwise."""
    best = min(found, key=lambda f: f.cost, default=None)
    done = best and (statistics(problem, best).at_the_floor or at_its_floor(problem, best))
    return frozenset(best.added) if best and done else frozenset()


def at_its_floor(problem: Problem, best: Fit) -> bool:
    """Whether the best explanation leaves but noise under the noise and the weight of priors that go with itself.

    Those of the search go with what was best before it: under them a right pair is held off its minimum.
    """
    own, best = with_priors_weighed(with_noise_of(problem, best), best)
    again = refit(best, own, share=one_stage(own.work))
    return not statistics(own, again).structured


def diverse(fits: Sequence[Fit]) -> list[Fit]:
    """The three best explanations, at most two of them with a law in place of the same nominal parameters."""
    kept: list[Fit] = []
    for f in fits:
        alike = [k for k in kept if replaced(k) and replaced(k) == replaced(f)]
        if len(alike) < 2:
            kept.append(f)
    return kept[:3]


def left_out(problem: Problem, nominal: Fit, bases: Sequence[Fit], wanted: Sequence[str]) -> list[Fit]:
    """The nominal model with each plain law that the data sheet leaves out, as dry friction, where it is not a base.

    Every drive has some. Where something else is missing too, that may hide how much it explains by itself, and what
    else is missing may show beside it alone.
    """
    found = list[Fit]()
    for (parameter,), name in plain_laws().items():
        known = problem.prior.motor.get(parameter) or any(base.added == (name,) for base in bases)
        if name in wanted and not known:
            begun = hypothesis(problem.prior, (name,), problem.scales, {}, nominal.motor)
            found.append(fit(problem, begun, share=one_stage(problem.work)))
    return found


def made_of(this: Fit, wanted: Sequence[str]) -> bool:
    """Whether an explanation has no effects but those that are wanted, and steady loads."""
    return all(name in wanted or this.hypothesis.table[name].steady for name in this.added)
