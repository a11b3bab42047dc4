"""Signals that went through filters of their sensors which are known: undone, or fitted beside everything else."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from rwn.fit.prior import Nuisance
from rwn.fit.problem import Problem
from rwn.measurement.filter_colour import SensorFilter
from rwn.model.model import Model
from rwn.model.vocabulary import analog_filters
from rwn.recording.filters import share_before
from rwn.recording.noise import Noise


def filtered(problem: Problem, filters: Sequence[SensorFilter]) -> Problem:
    """The problem with the filters undone where they are digital, else among what every hypothesis fits.

    Those of noise alone colour it.
    """
    for f in filters:
        if f.of_noise:
            problem = _coloured(problem, f)
        else:
            problem = undone(problem, f.signal, f.time_constant) if f.digital else _as_nuisance(problem, f)
    return problem


def _coloured(problem: Problem, f: SensorFilter) -> Problem:
    noise = {**problem.noise, f.signal: replace(problem.noise[f.signal], reflection=f.reflection)}
    return replace(problem, coloured={**problem.coloured, f.signal: f.reflection}, noise=noise)


def stating_filters(model: Model, filters: Mapping[str, float]) -> Model:
    """The model with filters [s] by signal in its recordings' layout, beside those that are there."""
    known = {**model.recording.filters, **filters}
    return replace(model, recording=replace(model.recording, filters=known)) if filters else model


def known_filters(problem: Problem) -> tuple[SensorFilter, ...]:
    """The filters that a problem was given, see `filtered`."""
    fitted = {n.effect: next(iter(n.values.values())) for n in problem.prior.nuisance}
    lags = {s: fitted[lag.name] for s, lag in analog_filters(problem.prior.table).items() if lag.name in fitted}
    of_motion = [
        SensorFilter(signal=s, share=problem.share_kept(s, time), time_constant=time, digital=digital)
        for times, digital in ((problem.filters, True), (lags, False))
        for s, time in times.items()
    ]
    of_noise = [
        SensorFilter(signal=s, share=of[0], time_constant=problem.time_kept(s, of[0]), reflection=of)
        for s, of in problem.coloured.items()
    ]
    return (*of_motion, *of_noise)


def noise_before_filters(problem: Problem, noise: Mapping[str, Noise]) -> dict[str, Noise]:
    """Noise as recorded, as it is where the filters of a problem are undone: a filter had taken some of it off."""
    before = dict(noise)
    for signal, time_constant in problem.filters.items():
        if signal in before:
            share = problem.share_kept(signal, time_constant)
            mixed = share_before(share, _ticks_per_row(problem))
            before[signal] = before[signal].scaled(float(np.sqrt((1.0 + share) / (1.0 - share))) / (1.0 - mixed))
            if mixed:
                before[signal] = replace(before[signal], reflection=(-mixed / (1.0 - mixed),))
    return before


def _as_nuisance(problem: Problem, f: SensorFilter) -> Problem:
    """The problem with an analog filter among what every hypothesis fits, and with noise that went through it."""
    lag = analog_filters(problem.prior.table)[f.signal]
    (p,) = lag.parameters
    own = Nuisance(effect=lag.name, values={p.name: f.time_constant}, spread={p.name: f.spread})
    prior = replace(problem.prior, nuisance=(*problem.prior.nuisance, own))
    return replace(
        problem, prior=prior, noise={**problem.noise, f.signal: replace(problem.noise[f.signal], reflection=(f.share,))}
    )


def undone(problem: Problem, signal: str, time_constant: float) -> Problem:
    """The problem with the signal as it was before a digital filter, and with the noise that it had there."""
    runs, whole = (
        tuple(r.unfiltered(signal, time_constant) if r.signal(signal).size else r for r in of)
        for of in (problem.runs, problem.whole)
    )
    filters = {**problem.filters, signal: time_constant}
    noise = noise_before_filters(replace(problem, filters={signal: time_constant}), problem.noise)
    return replace(problem, runs=runs, whole=whole, noise=noise, filters=filters)


def log_density(problem: Problem) -> float:
    """Logarithm of the Jacobian of the digital filters that a problem undoes: recorded samples lie closer together.

    Taken off the log-likelihood of samples as they were before the filters, it leaves that of the recorded ones.
    """
    found = 0.0
    for signal, time_constant in problem.filters.items():
        share = problem.share_kept(signal, time_constant)
        new = (1.0 - share) * (1.0 - share_before(share, _ticks_per_row(problem)))
        found += sum(r.signal(signal).size for r in problem.runs) * float(np.log(new))
    return found


def _ticks_per_row(problem: Problem) -> int:
    return max(r.ticks_per_row for r in problem.runs)
