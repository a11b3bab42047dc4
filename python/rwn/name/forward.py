"""Forward selection: the nominal model, every effect alone, and what still helps beside the best."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np

from rwn.fit.budget import affords_more, renew
from rwn.fit.coloured_noise import final_fits
from rwn.fit.fit import Fit, best_few, fit_nominal, refit_all
from rwn.fit.nominal import weighted_by_nominal
from rwn.fit.prior_weight import with_priors_weighed
from rwn.fit.problem import Problem
from rwn.fit.refitting import refitted_beside
from rwn.fit.residual_noise import with_noise_of
from rwn.fit.residuals import Statistics, statistics
from rwn.fit.secant import all_down_secants
from rwn.measurement.angle import along_the_simulated_angle
from rwn.measurement.coarse_speed import as_recorded, recorded_steps, unrounded_fits
from rwn.measurement.filter_colour import SensorFilter
from rwn.name.backward import distinct, with_simpler
from rwn.name.degenerate import adds
from rwn.name.extending import at_its_floor, beside_and_in_windows, diverse, left_out, made_of
from rwn.name.further_lines import with_further_lines
from rwn.name.measurement import Measurement, is_explained
from rwn.name.multiple_shooting import fitted_in_windows, fitted_to_free_run, has_lost_the_motion
from rwn.name.not_tried import NotTried
from rwn.name.observable import observable
from rwn.name.prior_odds import loaded, prior_odds, steady_loads
from rwn.name.ranking import NO_EXTENSIONS, Extensions, Fits, Ranking
from rwn.name.replacement import with_plainer_instead
from rwn.name.screening import OF_THE_MACHINE, screen
from rwn.name.weights import weigh

Progress = Callable[[str, float], None]

MOST_EFFECTS = OF_THE_MACHINE + 1  # in one explanation: a sensor or an actuator shows beside what acts in the machine


class _ForwardSelection(NamedTuple):
    """Explanations by more and more effects."""

    fits: list[Fit]
    extensions: Extensions
    paired: bool  # some have several effects
    complete: bool  # more effects at once would not help
    not_tried: tuple[NotTried, ...]
    measured: Measurement | None = None  # how recordings were made, where it proved to be otherwise before the end


def rank(
    problem: Problem, *, progress: Progress, names: Sequence[str] | None = None, at_once: int = MOST_EFFECTS,
    after: Ranking | None = None, filters: Sequence[SensorFilter] = (), known: Sequence[Fit] = (),
) -> Ranking:  # fmt: skip
    """Fits the nominal model, every single effect, and what still helps beside the best ones, `at_once` at most.

    `names`: of the effects that are tried; such a ranking is for comparison, simpler explanations than its best are
    not. `after`: a ranking of the same recordings by fewer effects, or by some of them, to go on from. `filters`: of
    the sensors, that are known; the problem is without them. `known`: see `_ranked`.
    """
    made = after.measurement if after else Measurement(as_prepared=problem, filters=tuple(filters))
    return _ranked(made, progress=progress, names=names, at_once=at_once, after=after, known=known)


def _ranked(
    made: Measurement, *, progress: Progress, names: Sequence[str] | None = None, at_once: int = MOST_EFFECTS,
    after: Ranking | None = None, known: Sequence[Fit] = (),
) -> Ranking:  # fmt: skip
    """The ranking under one measurement, or under the one that its best explanation shows (see `rank`).

    `known`: explanations that were found under another measurement.
    """
    problem = made.problem
    begun = problem.work.done
    wanted = [n for n in names or problem.prior.table if observable(n, problem)]
    alone = after.alone if after else _each_alone(problem, wanted, progress)
    problem, nominal, fits = alone.problem, alone.nominal_fit, [f for f in alone.fits if made_of(f, wanted)]
    before = statistics(problem, nominal)
    extensions = after.extensions if after else NO_EXTENSIONS
    in_noise = partial(made.in_noise, problem) if names is None and not after else None
    again = refitted_beside(known, problem)
    grown = _grown(alone, fits, wanted, extensions, at_once=at_once, begun=begun, progress=progress, otherwise=in_noise,
                   known=again if made.changes else ())  # fmt: skip
    fits = distinct([*grown.fits, *again])
    if grown.paired or again:
        problem, nominal, fits, _ = _under_own_noise(problem, nominal, fits)
    if names is None and not grown.measured:
        fits = with_plainer_instead(problem, with_simpler(problem, nominal, fits), wanted, begun=begun)
    best = min([nominal, *fits], key=lambda f: f.cost)
    measured = grown.measured or made.otherwise(problem, best, completely=at_once == MOST_EFFECTS, others=fits)
    while measured:  # otherwise than thought, beside whatever is missing
        renew(problem.work, begun)
        found = _ranked(measured, progress=progress, at_once=1)
        if names is not None or at_once > 1:
            renew(problem.work, begun)
            several = [f for f in best_few(fits) if len(f.added) > 1]  # a second search may not afford to find them
            found = _ranked(measured, progress=progress, names=names, at_once=at_once, after=found, known=several)
        if made.supposed or not measured.supposed or is_explained(found.left, statistics(problem, best)):
            return found
        made = replace(made, of_one_machine=True)
        measured = made.otherwise(problem, best, completely=True, others=fits)
    at_a_limit = [f for f in fits if f.limits_met]
    fits = [f for f in fits if not f.limits_met and adds(f, problem)]
    best, left = _best_of(problem, [nominal, *fits])
    weighted, finals, counted = final_fits(problem, [nominal, *fits], left)
    ranked = weigh([nominal, *fits], counted, rivals=len(wanted), prior=prior_odds(problem), finals=finals)
    # disturbances are no account of what the nominal model lacks: it is shown as plainly fitted
    ranked = [r if r.added else replace(r, final=nominal) for r in ranked]
    return Ranking(
        problem=problem,
        measurement=made,
        nominal_fit=nominal,
        fits=tuple(ranked),
        left=left,
        before=before,
        weighted=weighted,
        counted=counted,
        alone=alone,
        extensions=grown.extensions,
        speed_steps=recorded_steps(problem, best),
        complete=names is None and (grown.complete or at_once >= MOST_EFFECTS),
        not_tried=() if left.at_the_floor else grown.not_tried,
        at_a_limit=tuple(f for f in at_a_limit if f.cost < best.cost),
    )


def _grown(
    alone: Fits, fits: list[Fit], wanted: Sequence[str], extensions: Extensions, *, at_once: int, begun: int,
    progress: Progress, otherwise: Callable[[Fit], Measurement | None] | None = None, known: Sequence[Fit] = (),
) -> _ForwardSelection:  # fmt: skip
    """Single effects, then the best of them with more beside, as long as that helps.

    `extensions` are known already. `begun`: what the meter of the search had counted when it began. `otherwise`: how
    the recordings were made, by the best of each number of effects; None: as thought. Nothing is built on that under
    another measurement than theirs. `known`: explanations by several effects, to go on from.
    """
    problem = alone.problem
    fits = distinct([*with_further_lines(problem, fits), *known])
    best, left = _best_of(problem, [alone.nominal_fit, *fits])
    bases, windowed = diverse([f for f in fits if adds(f, problem)]), alone.windowed
    if further := _best_by_several(known, problem):
        bases, thorough, least = further, 1, len(further[0].added) + 1
    else:
        first = left_out(problem, alone.nominal_fit, bases, wanted) if bases and left.structured else []
        bases, thorough, least = [*first, *bases], len(first) + 1, 2
    complete, paired, measured = not left.structured or not bases, False, None
    not_tried = list[NotTried]()
    for size in range(least, at_once + 1):
        measured = otherwise(best) if otherwise and not complete else None
        if complete or measured:
            break
        tried = extensions if size == 2 else NO_EXTENSIONS
        renew(problem.work, begun)
        progress(f"trying {size} effects at once", 0.9 - 0.7 * 0.5 ** (size - 1))
        found, windowed = beside_and_in_windows(
            alone, best, bases, wanted, fits, tried, size=size, windowed=windowed, thorough=thorough
        )  # fmt: skip
        more, extensions = with_further_lines(problem, found.fits), found if size == 2 else extensions
        not_tried += found.not_tried
        complete = not _is_worth_it(problem, more, best, rivals=len(wanted))
        if complete:
            break
        fits, paired = [*fits, *more], True
        best, left = _best_of(problem, fits)
        bases, thorough = _best_by_several(more, problem), 1
        complete = not left.structured or at_its_floor(problem, best)
    return _ForwardSelection(fits, extensions, paired, complete, tuple(not_tried), measured)


def _best_by_several(fits: Sequence[Fit], problem: Problem) -> list[Fit]:
    """The explanations to go on from, once there are some by several effects."""
    return sorted((f for f in fits if adds(f, problem)), key=lambda f: f.cost)[:2]


def _is_worth_it(problem: Problem, more: Sequence[Fit], best: Fit, *, rivals: int) -> bool:
    """Whether one of `more` is likelier than what was `best`, by the evidence that explanations are weighed with."""
    closest, left = _best_of(problem, [best, *more])
    likeliest = weigh([best, *more], left, rivals=rivals, prior=prior_odds(problem))[0].fit
    return closest is not best and likeliest is not best


def _best_of(problem: Problem, fits: Sequence[Fit]) -> tuple[Fit, Statistics]:
    """The explanation that fits best, and what it leaves."""
    best = min(fits, key=lambda f: f.cost)
    return best, statistics(problem, best)


def _weighted_beforehand(problem: Problem) -> tuple[Problem, Fit]:
    """The problem, weighted by the noise that the refitted nominal model leaves, and that model."""
    problem, nominal = weighted_by_nominal(problem)
    within, _ = with_priors_weighed(problem, nominal)
    return (problem, nominal) if within is problem else (within, fit_nominal(within))


def _each_alone(problem: Problem, wanted: Sequence[str], progress: Progress) -> Fits:
    """The nominal model and every single effect."""
    problem, nominal = _weighted_beforehand(problem)
    progress("trying every effect", 0.1)
    fits = screen(problem, nominal, wanted)
    if loaded(problem):
        for offset in screen(problem, nominal, steady_loads(problem)):
            fits = distinct([*fits, *screen(problem, offset, wanted)])
    windowed: list[Fit] = []
    if affords_more(problem.work) and has_lost_the_motion(problem, min([nominal, *fits], key=lambda f: f.cost)):
        windowed = fitted_in_windows(problem, nominal, wanted, 1)
        fits = distinct([*fits, *fitted_to_free_run(windowed, problem)])
    return _under_own_noise(problem, nominal, fits)._replace(windowed=windowed)


def _under_own_noise(problem: Problem, nominal: Fit, fits: list[Fit]) -> Fits:
    """The fits under the noise, along the angle and to the speed that the best of them makes probable."""
    problem, nominal, fits = _reweighted(as_recorded(problem), nominal, fits)
    problem, nominal, fits = along_the_simulated_angle(problem, nominal, fits)
    fits = all_down_secants(problem, nominal, fits)
    return Fits(*unrounded_fits(problem, nominal, fits))


def _reweighted(problem: Problem, nominal: Fit, fits: list[Fit]) -> tuple[Problem, Fit, list[Fit]]:
    """The same fits under the noise levels that the best one leaves, where they differ."""
    best = min([nominal, *fits], key=lambda f: f.cost)
    other, free = with_priors_weighed(with_noise_of(problem, best), best)
    change = max(abs(np.log(n.level / problem.noise[s].level)) for s, n in other.noise.items())
    change = max(change, abs(np.log(other.inflation / problem.inflation)) / 30.0)
    if change < 0.03:
        return problem, nominal, fits
    # each by the cost that it was screened with: the others may gain as much once priors weigh less
    begun = replace(best, minimum=replace(best.minimum, values=free.minimum.values))
    first, *rest = refit_all([begun if f is best else f for f in (nominal, *best_few(fits))], other)
    return other, first, sorted(rest, key=lambda f: f.cost)
