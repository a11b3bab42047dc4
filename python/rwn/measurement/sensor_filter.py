"""First-order filters of the sensors, seen in the noise that went through them.

Whether the motion went through such a filter too, sample by sample or as an analog signal, the likelihood decides.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from rwn.fit.budget import one_stage
from rwn.fit.fit import Fit, fit
from rwn.fit.hypothesis import hypothesis
from rwn.fit.problem import Problem
from rwn.fit.refitting import refitted_beside
from rwn.fit.residual_noise import with_noise_of
from rwn.fit.residuals import loss_gained, statistics
from rwn.fit.screening_part import screening_part
from rwn.measurement.beside_filters import (
    SPACING,
    likelihood_beside,
    losses_beside,
    refitted,
    shown_through,
)
from rwn.measurement.filter_colour import SLOWEST, SensorFilter, certain, coloured_signals
from rwn.measurement.known_filters import filtered
from rwn.measurement.likelihood import DECISIVE, is_decisive
from rwn.measurement.noise_spectrum import FASTEST, NoiseColour
from rwn.parallel import side_by_side

Array = NDArray[np.float64]

LIKELY = 4.0  # standard deviations from what the noise tells, within which they lie
DIPS = 3  # lowest values of the likelihood over phi, around which it is refined
LOG_TOLERANCE = 0.01  # tolerance of the logarithm of a time constant: its standard deviation at N = 10 000
SIMPLEX = 0.2  # step of the logarithms of time constants, from which those of several filters are fitted together
ROUNDS = 2  # in which the filters of several signals are estimated beside each other


def sensor_filters(problem: Problem, this: Fit) -> tuple[SensorFilter, ...]:
    """The filters that the errors of a fit show; none of signals that the model filters by itself."""
    return filters_and_likelihood(problem, this)[0]


def shown_in_noise(problem: Problem, this: Fit) -> bool:
    """Whether the noise itself shows a filter, whatever a fit leaves beside it."""
    seen = coloured_signals(problem, problem.residuals(this.vector, this.active))
    return certain(seen) and any(one.share < SLOWEST for one in seen)


def filters_again(problem: Problem, explanation: Fit, known: Sequence[SensorFilter]) -> tuple[SensorFilter, ...]:
    """The filters beside an explanation that was found under those that are `known`, which the problem is without."""
    return filters_and_likelihood(with_noise_of(problem, explanation), explanation, known)[0]


def filters_and_likelihood(
    problem: Problem, this: Fit, known: Sequence[SensorFilter] = ()
) -> tuple[tuple[SensorFilter, ...], float]:
    """The filters that the errors of a fit show, and how likely the recordings are with these (log, BIC).

    `known`: filters under which the fit was found; they stay unless others are decisively likelier. Without them it
    would lose itself in what they did to the motion.
    """
    beside = filtered(problem, known)
    if known:
        (this,) = refitted_beside([this], beside)
    residuals = shown_through(known, beside, beside.residuals(this.vector, this.active))
    seen = coloured_signals(problem, residuals)
    if not certain(seen) and statistics(problem, this).at_the_floor:  # else what is missing may hide it
        seen = []
    told = {one.signal: one.noise for one in seen}
    seen = [*seen, *(replace(f, digital=False) for f in known if f.signal not in told)]
    if not seen:
        return (), likelihood_beside(problem, this, ())
    found = [_filters_beside(problem, base, seen, told) for base in _bases(beside, this)]
    filters, score, likelihood = max(found, key=lambda one: one[1])
    if known:
        stays = likelihood_beside(problem, this, known)
        on = filtered(problem, filters)
        if not is_decisive(score - stays - _by_noise(told, known), statistics(on, refitted(this, on))):
            return tuple(known), stays
    return filters, likelihood


def _by_noise(told: Mapping[str, NoiseColour], filters: Sequence[SensorFilter]) -> float:
    """How likely (log) the noise by itself is with these filters; `told`: what it shows of each signal."""
    shares = {f.signal: f.share for f in filters}
    return sum(one.log_likelihood(shares.get(signal, 0.0)) for signal, one in told.items())


def _filters_beside(
    problem: Problem, base: Fit, seen: Sequence[SensorFilter], told: Mapping[str, NoiseColour]
) -> tuple[tuple[SensorFilter, ...], float, float]:  # fmt: skip
    """The filters beside an explanation, what speaks for them, and how likely both are (log, BIC)."""
    found: dict[str, SensorFilter] = {}
    asked: dict[str, list[SensorFilter]] = {}
    known = list(seen)
    for _ in range(ROUNDS):
        for one in known:  # what one signal shows depends on the others' filters
            others = [f for f in found.values() if f.signal != one.signal]
            if asked.get(one.signal) == others:
                continue
            asked[one.signal] = others
            on = filtered(problem, others)
            best = _likeliest_kind(on, refitted(base, on), found.get(one.signal, one), told)
            found = {f.signal: f for f in (*others, best) if f is not None}
        uncovered = _uncovered(problem, base, tuple(found.values()), known)
        known += uncovered
        told = {**told, **{one.signal: one.noise for one in uncovered}}
        if len(known) == 1:
            break
    one_by_one = _together(problem, base, tuple(found.values()), told)
    at_once = _all_at_once(problem, base, found, known, told)
    likelihoods = {filters: likelihood_beside(problem, base, filters) for filters in {one_by_one, at_once}}
    filters = max(likelihoods, key=lambda f: likelihoods[f] + _by_noise(told, f))
    return filters, likelihoods[filters] + _by_noise(told, filters), likelihoods[filters]


def _all_at_once(
    problem: Problem, base: Fit, found: Mapping[str, SensorFilter], known: Sequence[SensorFilter],
    told: Mapping[str, NoiseColour],
) -> tuple[SensorFilter, ...]:  # fmt: skip
    """Digital filters of all signals that may have one; those that were found one by one, if together they err more.

    While one signal's filter is not undone the other's seems shorter, by as much as the first lags behind it, and
    beside that the first seems to have none.
    """
    together = tuple(found.get(f.signal, replace(f, digital=True)) for f in {f.signal: f for f in known}.values())
    alone = tuple(found.values())
    if len(together) == len(alone) or not all(f.digital for f in together):
        return alone
    filters = _together(problem, base, together, told)
    lost = loss_gained(losses_beside(problem, base, alone), losses_beside(problem, base, filters))
    return filters if lost < 0.0 else alone


def _uncovered(
    problem: Problem, base: Fit, found: Sequence[SensorFilter], known: Sequence[SensorFilter]
) -> list[SensorFilter]:
    """The signals besides those that are `known`, whose noise shows a filter once those that were found are counted."""
    if not found:
        return []
    on = filtered(problem, found)
    this = refitted(base, on)
    seen = coloured_signals(on, on.residuals(this.vector, this.active))
    new = [one for one in seen if one.signal not in {k.signal for k in known} and one.share < SLOWEST]
    return new if certain(seen) else []


def _together(
    problem: Problem, base: Fit, found: tuple[SensorFilter, ...], told: Mapping[str, NoiseColour]
) -> tuple[SensorFilter, ...]:  # fmt: skip
    """The digital filters at the time constants that are likeliest together.

    Estimated one after the other they end elsewhere where there is a delay, which makes up for what either lacks.
    """
    from scipy.optimize import minimize  # late: the command line starts without it

    digital = [f for f in found if f.digital]
    if len(digital) < 2:
        return found

    def at(logarithms: Array) -> tuple[SensorFilter, ...]:
        moved = {f.signal: _of_time(problem, f, float(np.exp(x))) for f, x in zip(digital, logarithms, strict=True)}
        return tuple(moved.get(f.signal, f) for f in found)

    def negative_likelihood(logarithms: Array) -> float:
        filters = at(logarithms)
        inside = all(FASTEST <= f.share <= SLOWEST for f in filters)
        return -likelihood_beside(problem, base, filters) - _by_noise(told, filters) if inside else np.inf

    start = np.log([f.time_constant for f in digital])
    simplex = np.vstack([start, start + SIMPLEX * np.eye(start.size)])
    best = minimize(negative_likelihood, start, method="Nelder-Mead",
                    options={"initial_simplex": simplex, "xatol": LOG_TOLERANCE, "fatol": np.inf})  # fmt: skip
    return at(best.x)


def _of_time(problem: Problem, f: SensorFilter, time_constant: float) -> SensorFilter:
    return replace(f, time_constant=time_constant, share=problem.share_kept(f.signal, time_constant))


def _bases(problem: Problem, this: Fit) -> Iterator[Fit]:
    """The explanation, and what of it may imitate a filter left out: lags, delays and resonances, or all of it."""
    yield this
    effects = {name: problem.prior.table[name] for name in this.added}
    prompt = tuple(name for name, effect in effects.items() if not (effect.retards or effect.second_mass))
    for kept in (k for k in dict.fromkeys([prompt, ()]) if k != this.added):
        begun = hypothesis(problem.prior, kept, problem.scales, this.starts(kept), this.motor)
        yield fit(problem, begun, share=one_stage(problem.work))


def _likeliest_kind(
    problem: Problem, this: Fit, seen: SensorFilter, told: Mapping[str, NoiseColour]
) -> SensorFilter | None:
    """The filter, digital or analog, under which the errors are likelier than as coloured noise alone; None: neither.

    They are compared by BIC, as a filter has a time constant more. Where much is missing, or where the input is noisy,
    any filter makes errors likelier or less likely without being there: so one with which the recordings are not
    simulated better is none. A digital filter, which sees nothing between the rows, has to be decisively likelier than
    an analog one, since what drives log is filtered at a faster rate. What is missing lasts in the errors of both:
    their difference counts in independent samples.
    """
    analog, digital = replace(seen, digital=False), _digital(problem, this, seen, told)

    def score(filters: Sequence[SensorFilter]) -> float:
        return likelihood_beside(problem, this, filters) + _by_noise(told, filters)

    plain = losses_beside(problem, this, ())
    simulated_better = [f for f in (analog, digital) if loss_gained(plain, losses_beside(problem, this, [f])) < 0.0]
    scores, without = {f: score([f]) for f in simulated_better}, score([])
    likely = {f: found for f, found in scores.items() if found > without}
    if len(likely) == 2:
        on = filtered(problem, [digital])
        left = statistics(on, refitted(this, on))
        gained = (likely[digital] - likely[analog]) * left.effective / max(left.count, 1)
        return digital if gained > DECISIVE else analog
    return next(iter(likely), None)


def _digital(problem: Problem, this: Fit, seen: SensorFilter, told: Mapping[str, NoiseColour]) -> SensorFilter:
    """The digital filter under which the errors are likeliest."""
    from scipy.optimize import minimize_scalar  # late: the command line starts without it

    def negative_score(problem: Problem, logarithm: float) -> float:
        f = _of_time(problem, replace(seen, digital=True), float(np.exp(logarithm)))
        return -likelihood_beside(problem, this, [f]) - _by_noise(told, [f])

    def refined(between: Array) -> tuple[float, float]:
        best = minimize_scalar(
            partial(negative_score, problem), bounds=between, method="bounded", options={"xatol": LOG_TOLERANCE}
        )
        return float(best.fun), float(best.x)

    one = float(np.log(seen.time_constant * -np.log(seen.share)))  # of the time of a sample
    least = max(seen.noise.share - LIKELY * seen.noise.deviation, FASTEST)
    most = min(seen.noise.share + LIKELY * seen.noise.deviation, SLOWEST)
    tried = one - np.log(-np.log(np.linspace(least, most, max(round((most - least) / SPACING), 2) + 1)))
    part = screening_part(problem, this)
    scores = np.array(side_by_side(lambda t: negative_score(part, float(t)), tried))
    beside = np.concatenate([[np.inf], scores, [np.inf]])
    dips = np.flatnonzero((scores <= beside[:-2]) & (scores <= beside[2:]))  # another motor may do with another filter
    around = [tried[[max(k - 1, 0), min(k + 1, tried.size - 1)]] for k in dips[np.argsort(scores[dips])][:DIPS]]
    _, logarithm = min(side_by_side(refined, around))
    return _of_time(problem, replace(seen, digital=True), float(np.exp(logarithm)))
