"""First-order filters of the sensors, seen in the noise that went through them.

Noise that a filter y_k = phi y_{k-1} + (1 - phi) x_k has passed goes from sample to sample with phi = exp(-T / tau).
Differences of the residual show it, since what else may be missing is smooth between its sharp instants, and few
windows hold one. Whether the motion went through it too, sample by sample or as an analog signal, the likelihood
decides.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rwn.fit.budget import one_stage, shares_by_rank
from rwn.fit.fit import Fit, fit
from rwn.fit.hypothesis import hypothesis
from rwn.fit.likelihood import log_posterior
from rwn.fit.prior import Nuisance
from rwn.fit.prior_weight import BELIEVABLE
from rwn.fit.problem import Problem
from rwn.fit.residuals import statistics
from rwn.model.model import Model
from rwn.model.vocabulary import analog_filters
from rwn.parallel import side_by_side
from rwn.recording.noise import Noise, noise_from_differences
from rwn.simulate.run import Run

Array = NDArray[np.float64]

WINDOW = 64  # samples
CERTAIN = 5.0  # standard deviations of the autocorrelation of white noise
LEAST, MOST = 0.1, 0.95  # of phi: a filter faster than half a sample changes nothing, a slower one is physics
NOISE_ALONE = 2.0  # variance of what is new in a residual against its rough noise, up to which it is noise alone
ITERATIONS = 8  # of a fit that begins near its end
SHARES = 24  # values of phi that are compared: at few rows a time constant the right one is told to a few per cent
DIPS = 3  # lowest values of the likelihood over phi, around which it is refined
LOG_TOLERANCE = 0.01  # tolerance of the logarithm of a time constant: its standard deviation at N = 10 000
ROUNDS = 2  # in which the filters of several signals are estimated beside each other


@dataclass(frozen=True, kw_only=True)
class SensorFilter:
    """A first-order filter of one signal."""

    signal: str
    share: float  # phi: of a sample's noise that was in the sample before
    time_constant: float  # [s]
    digital: bool = False  # it takes samples, as a drive's program does; else it is fitted as a law of the sensor


def sensor_filters(problem: Problem, this: Fit) -> tuple[SensorFilter, ...]:
    """The filters that the errors of a fit show; none of signals that the model filters by itself."""
    residuals = problem.residuals(this.vector, this.active)
    seen = coloured_signals(problem, residuals)
    hidden = not seen or any(one.share >= MOST for one in seen)
    if hidden and not statistics(problem, this).at_the_floor:
        slow = _with_lags(problem, this)
        residuals = problem.residuals(slow.vector, slow.active)
        seen = coloured_signals(problem, residuals) or seen
    if not seen:
        return ()
    found = [_filters_beside(problem, base, seen, residuals) for base in _without_lags(problem, this)]
    return max(found, key=lambda pair: pair[1])[0]


def _filters_beside(
    problem: Problem, base: Fit, seen: Sequence[SensorFilter], residuals: Sequence[Mapping[str, Array]]
) -> tuple[tuple[SensorFilter, ...], float]:
    """The filters beside an explanation, and how likely both are (log, BIC)."""
    found: dict[str, SensorFilter] = {}
    for _ in range(ROUNDS if len(seen) > 1 else 1):  # what one signal shows depends on the others' filters
        for one in seen:
            others = [f for f in found.values() if f.signal != one.signal]
            on = filtered(problem, others)
            best = _likeliest_kind(on, _refitted(base, on), found.get(one.signal, one))
            if best is None and _is_noise_alone(problem, residuals, one):
                best = one
            found = {f.signal: f for f in (*others, best) if f is not None}
    on = filtered(problem, tuple(found.values()))
    this = _refitted(base, on)
    shown = sum(_samples(problem, f.signal) * float(np.log(1.0 - f.share)) for f in found.values() if f.digital)
    unknowns = len(this.hypothesis.unknowns) + len(on.filters)
    return tuple(found.values()), log_posterior(on, this) - shown - 0.5 * unknowns * float(np.log(problem.samples))


def _samples(problem: Problem, signal: str) -> int:
    return sum(r.signal(signal).size for r in problem.runs)


def stating_filters(model: Model, filters: Mapping[str, float]) -> Model:
    """The model with filters [s] by signal in its recordings' layout, beside those that are there."""
    known = {**model.recording.filters, **filters}
    return replace(model, recording=replace(model.recording, filters=known)) if filters else model


def coloured_signals(problem: Problem, residuals: Sequence[Mapping[str, Array]]) -> list[SensorFilter]:
    """The signals whose noise looks as if it had passed a filter, with the filter that would have done it.

    `residuals`: (n,) of each run, by signal.
    """
    found = []
    for signal, lag in analog_filters(problem.prior.table).items():
        parts = [(run, left[signal]) for run, left in zip(problem.runs, residuals, strict=True) if signal in left]
        parts = [(run, x) for run, x in parts if _is_sensor_noise(run, signal, x)]
        if not parts or signal in problem.filters or lag.name in problem.prior.effects:
            continue
        share = _estimated_share([run.masked(signal, x) for run, x in parts])
        if share > LEAST:
            share = min(share, MOST)
            step = float(np.median([run.sample_time for run, _ in parts]))
            found.append(SensorFilter(signal=signal, share=share, time_constant=-step / float(np.log(share))))
    return found


def filtered(problem: Problem, filters: Sequence[SensorFilter]) -> Problem:
    """The problem with the filters undone where they are digital, else among what every hypothesis fits."""
    for f in filters:
        problem = _undone(problem, f.signal, f.time_constant) if f.digital else _as_nuisance(problem, f)
    return problem


def _as_nuisance(problem: Problem, f: SensorFilter) -> Problem:
    """The problem with an analog filter among what every hypothesis fits, and with noise that went through it."""
    lag = analog_filters(problem.prior.table)[f.signal]
    (p,) = lag.parameters
    own = Nuisance(effect=lag.name, values={p.name: f.time_constant}, spread={p.name: 1.0})
    prior = replace(problem.prior, nuisance=(*problem.prior.nuisance, own))
    return replace(
        problem, prior=prior, noise={**problem.noise, f.signal: replace(problem.noise[f.signal], reflection=(f.share,))}
    )


def _undone(problem: Problem, signal: str, time_constant: float) -> Problem:
    """The problem with the signal as it was before a digital filter, and with the noise that it had there."""
    runs, whole = (
        tuple(r.unfiltered(signal, time_constant) if r.signal(signal).size else r for r in of)
        for of in (problem.runs, problem.whole)
    )
    filters = {**problem.filters, signal: time_constant}
    noise = noise_before_filters(replace(problem, filters={signal: time_constant}), problem.noise)
    return replace(problem, runs=runs, whole=whole, noise=noise, filters=filters)


def noise_before_filters(problem: Problem, noise: Mapping[str, Noise]) -> dict[str, Noise]:
    """Noise as recorded, as it is where the filters of a problem are undone: a filter had taken some of it off."""
    before = dict(noise)
    for signal, time_constant in problem.filters.items():
        if signal in before:
            share = _share_kept(problem, signal, time_constant)
            before[signal] = before[signal].scaled(float(np.sqrt((1.0 + share) / (1.0 - share))))
    return before


def _share_kept(problem: Problem, signal: str, time_constant: float) -> float:
    """phi of a filter."""
    step = float(np.median([r.sample_time for r in problem.runs if r.signal(signal).size]))
    return float(np.exp(-step / time_constant))


def _with_lags(problem: Problem, this: Fit) -> Fit:
    """The fit with the lag of every sensor: a filter that is not fitted hides its own noise."""
    lags = (lag.name for s, lag in analog_filters(problem.prior.table).items() if s in problem.noise)
    added = tuple(dict.fromkeys((*this.added, *(lag for lag in lags if lag not in problem.prior.effects))))
    starts = this.starts(this.added)
    begun = hypothesis(problem.prior, added, problem.scales, starts, this.motor)
    return fit(problem, begun, share=one_stage(problem.work))


def _without_lags(problem: Problem, this: Fit) -> Iterator[Fit]:
    """An explanation without lags of the sensors, without delays too, and the nominal model: all stand in for a filter.

    At few samples per time constant a spring behind the motor does as well as a lag, and then a filter of samples is
    never met beside the model that needs nothing else.
    """
    table = problem.prior.table
    without_lags = tuple(name for name in this.added if not table[name].filters)
    without_ends = tuple(name for name in without_lags if not table[name].at_an_end)
    for kept in dict.fromkeys((without_lags, without_ends, ())):
        if kept == this.added:
            yield this
            continue
        begun = hypothesis(problem.prior, kept, problem.scales, this.starts(kept), this.motor)
        yield fit(problem, begun, share=one_stage(problem.work))


def _refitted(this: Fit, problem: Problem) -> Fit:
    """The same explanation fitted to a problem that may hold other filters.

    A motor that has left what is declared of it may have done so in place of a filter: it begins anew.
    """
    starts = {name: this.values_of(name) for name in this.added}
    motor = this.motor if this.farthest_move < BELIEVABLE else None
    begun = hypothesis(problem.prior, this.added, problem.scales, starts, motor)
    return fit(problem, begun, max_iterations=ITERATIONS)


def _likeliest_kind(problem: Problem, this: Fit, seen: SensorFilter) -> SensorFilter | None:
    """The filter, digital or analog, under which the errors are likelier than as coloured noise alone; None: neither.

    By BIC: a filter has a time constant more.
    """
    lag = replace(seen, digital=False)
    analog = filtered(problem, [lag])
    sampled, score = _digital(problem, this, seen)
    scores: dict[SensorFilter | None, float] = {
        lag: log_posterior(analog, _refitted(this, analog)),
        None: log_posterior(problem, this) + 0.5 * np.log(problem.samples),
        sampled: score,
    }
    return max(scores, key=lambda which: scores[which])


def _digital(problem: Problem, this: Fit, seen: SensorFilter) -> tuple[SensorFilter, float]:
    """The digital filter under which the errors are likeliest, and their log-likelihood."""
    from scipy.optimize import minimize_scalar  # late: the command line starts without it

    samples = _samples(problem, seen.signal)

    def negative_log_posterior(logarithm: float) -> float:
        time_constant = float(np.exp(logarithm))
        on = _undone(problem, seen.signal, time_constant)
        shown = 1.0 - _share_kept(problem, seen.signal, time_constant)  # of what is new in a sample
        return samples * float(np.log(shown)) - log_posterior(on, _refitted(this, on))

    one = float(np.log(seen.time_constant * -np.log(seen.share)))  # of the time of a sample
    tried = one - np.log(-np.log(np.linspace(LEAST, MOST, SHARES)))
    scores = np.array([negative_log_posterior(float(t)) for t in tried])
    beside = np.concatenate([[np.inf], scores, [np.inf]])
    dips = np.flatnonzero((scores <= beside[:-2]) & (scores <= beside[2:]))  # another motor may do with another filter
    around = [tried[[max(k - 1, 0), min(k + 1, SHARES - 1)]] for k in dips[np.argsort(scores[dips])][:DIPS]]
    exact = {"xatol": LOG_TOLERANCE}
    refined = [minimize_scalar(negative_log_posterior, bounds=b, method="bounded", options=exact) for b in around]
    found = min(refined, key=lambda each: float(each.fun))
    time_constant = float(np.exp(found.x))
    share = _share_kept(problem, seen.signal, time_constant)
    return replace(seen, digital=True, time_constant=time_constant, share=share), -float(found.fun)


def _is_sensor_noise(run: Run, signal: str, residual: Array) -> bool:
    """Whether its noise is a sensor's: not that of counts or their difference, and larger than its steps."""
    if signal == "speed" and run.speed_measured.is_difference:
        return False
    return noise_from_differences(residual) > 2.0 * run.quantisation(signal)


def _estimated_share(residuals: Sequence[Array]) -> float:
    """phi of the noise of residuals (n,) each; 0 where it may be white."""
    once, twice = (np.concatenate([_lag_one_correlations(np.diff(x, n)) for x in residuals]) for n in (1, 2))
    if twice.size < 8:
        return 0.0
    shares = np.linspace(0.0, 0.99, 100)
    expected = np.array([_second_difference_correlation(p) for p in shares])
    seen = float(np.median(twice))
    if seen < expected[0] + CERTAIN * 1.25 * float(np.std(twice)) / np.sqrt(twice.size):  # deviation of a median
        return 0.0
    return min(float(np.interp(seen, expected, shares)), 1.0 + 2.0 * float(np.median(once)))


def _is_noise_alone(problem: Problem, residuals: Sequence[Mapping[str, Array]], seen: SensorFilter) -> bool:
    """Whether errors are noise of this colour and nothing else."""
    parts = [run.masked(seen.signal, r[seen.signal]) for run, r in zip(problem.runs, residuals, strict=True)
             if seen.signal in r]  # fmt: skip
    fresh = [x[1:] - seen.share * x[:-1] for x in parts]
    loud = max(float(np.nanmean(x**2)) / max(noise_from_differences(x) ** 2, 1e-300) for x in fresh)
    return loud < NOISE_ALONE


def _lag_one_correlations(x: Array) -> Array:
    """From one sample to the next, of each window of x (n,) that was measured throughout."""
    count = x.size // WINDOW
    windows = x[: count * WINDOW].reshape(count, WINDOW)
    windows = windows[np.isfinite(windows).all(axis=1)]
    energy = np.maximum(np.sum(windows**2, axis=1), 1e-300)
    found: Array = np.sum(windows[:, 1:] * windows[:, :-1], axis=1) / energy * (WINDOW / (WINDOW - 1))
    return found


def _second_difference_correlation(share: float) -> float:
    """Of second differences, from one sample to the next, of an autoregression of first order."""
    c = share ** np.arange(5.0)
    covariance = [6 * c[0] - 8 * c[1] + 2 * c[2], -4 * c[0] + 7 * c[1] - 4 * c[2] + c[3]]
    return float(covariance[1] / covariance[0])


def refitted_beside(known: Sequence[Fit], problem: Problem) -> list[Fit]:
    """Explanations refitted beside the filters that `problem` fits or that are undone, which are no part of them."""
    undone = {lag.name for s, lag in analog_filters(problem.prior.table).items() if s in problem.filters}
    measured = {n.effect for n in problem.prior.nuisance} | undone

    def again(pair: tuple[Fit, float]) -> Fit:
        this, share = pair
        added = tuple(n for n in this.added if n not in measured)
        starts = {n: this.values_of(n) for n in added}
        return fit(problem, hypothesis(problem.prior, added, problem.scales, starts, this.motor), share=share)

    shares = shares_by_rank(problem.work, [this.cost for this in known])
    return side_by_side(again, list(zip(known, shares, strict=True)))
