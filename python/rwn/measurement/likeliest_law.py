"""How the input acted between the rows, read off the recordings: the law under which what is left is likeliest."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rwn.fit.fit import NEAR_ITS_END, Fit, refit
from rwn.fit.nominal import nominal_of
from rwn.fit.problem import Problem
from rwn.fit.refitting import under_own_noise
from rwn.fit.residuals import CERTAINLY, loss_gained, statistics
from rwn.measurement.beside_filters import losses_beside, losses_of
from rwn.measurement.filter_colour import SensorFilter
from rwn.measurement.known_filters import filtered, log_density
from rwn.measurement.likelihood import DECISIVE, is_decisive, log_likelihood, log_posterior
from rwn.measurement.sensor_filter import filters_and_likelihood
from rwn.measurement.unrecorded_input import ROUNDS, has_unknown_input, rounds, with_inferred_input
from rwn.model.initial_state import CERTAIN
from rwn.model.model import Model
from rwn.parallel import side_by_side
from rwn.recording.clock import clock_beside, clock_of
from rwn.recording.intersample import AUTO, HELD, INTERSAMPLE
from rwn.recording.recording import Recording, beginnings

Array = NDArray[np.float64]

MOST_OFF = 0.5  # share of the rows of a signal that may be unknown: with more, little of it is left to be compared


def with_intersample(recordings: Sequence[Recording], model: Model) -> Model:
    """The model with the law that is likeliest under its refitted nominal structure, unless it states one.

    Raises InputError where a recording does not fit the model.
    """
    if model.recording.intersample != AUTO or model.drive.coefficients:
        return model
    timed = without_untimed(beginnings(recordings), model)
    return stating(model, likeliest(*nominal_of(timed, stating(model, HELD))))


def likeliest(problem: Problem, this: Fit) -> str:
    """The law under which the refitted errors of a fit are likeliest, decisively where the rows' times do not show it.

    What is new in an error may go with the input by another way than through the drive: a controller answers the noise
    of a row by the input of that row, and a cable picks up steps of the input. A law that predicts this is likelier
    without being right, so no law is taken that simulates the recordings certainly worse than another from their input
    alone.
    """
    candidates = _candidates(problem)

    def with_input(under_law: Problem) -> tuple[Problem, Fit]:
        found = refit(this, under_law, iterations=NEAR_ITS_END)
        if not has_unknown_input(under_law):
            return under_law, found
        told = under_law
        for _ in range(rounds(under_law)):
            told = with_inferred_input(told, found)
            found = refit(found, told, iterations=NEAR_ITS_END)
        return told, found

    refitted = dict(zip(candidates, side_by_side(with_input, candidates.values()), strict=True))
    return _chosen(refitted, {law: log_likelihood(*refitted[law]) for law in candidates})


def likeliest_with_filters(
    problem: Problem, explanation: Fit, stated: str, known: Sequence[SensorFilter] = ()
) -> tuple[str, tuple[SensorFilter, ...]]:
    """The law under which what is left beside an explanation is likeliest, with the filters that show under it.

    What a filter of a sensor leaves looks as if rows had been left out, and the other way round, so the two are judged
    together. Filters are looked for under the law that is `stated`, under "held", under the likeliest and the most
    accurate without any, and under those two with those that are `known`.

    Args:
        problem: the recordings as prepared, without filters of their sensors.
        explanation: found under whatever law and filters.
        stated: the law under which it was found.
        known: the filters under which it was found.
    """
    candidates = _candidates(problem)
    refitted = _all_explained(explanation, candidates)
    asked = {HELD, *_leading(refitted), *({stated} & set(candidates))}
    if known:
        asked |= _leading(_all_explained(explanation, candidates, known))
    if len(asked) == 1:
        return HELD, tuple(known)
    found = {law: _with_filters(candidates[law], explanation, known) for law in sorted(asked)}
    filters = {law: one.filters for law, one in found.items()}
    explained = {law: (one.problem, one.fit) for law, one in found.items()}
    law = _chosen(explained, {law: one.likelihood for law, one in found.items()}, filters)
    return law, filters[law]


class _Filtered(NamedTuple):
    """A problem under a law and a fit to it, with the filters that show beside these and how likely all are."""

    problem: Problem
    fit: Fit
    filters: tuple[SensorFilter, ...]
    likelihood: float


def _with_filters(problem: Problem, explanation: Fit, known: Sequence[SensorFilter]) -> _Filtered:
    """What is likeliest under a law: a filter that is not counted bends what is told of the input, and is told anew."""
    filters = tuple(known)
    for _ in range(ROUNDS):
        told, this = under_own_noise(explanation, _input_inferred(problem, explanation, filters))
        counted = {(f.signal, f.digital) for f in filters}
        filters, likelihood = filters_and_likelihood(told, explanation if filters else this, filters)
        if not has_unknown_input(problem) or counted == {(f.signal, f.digital) for f in filters}:
            break
    return _Filtered(problem=told, fit=this, filters=filters, likelihood=likelihood)


def _chosen(
    refitted: Mapping[str, tuple[Problem, Fit]], scores: Mapping[str, float],
    filters: Mapping[str, Sequence[SensorFilter]] | None = None,
) -> str:  # fmt: skip
    """The likeliest law, "held" where none is decisively so.

    For a law that the rows' times do not show, its gain counts in independent samples. No law is taken that simulates
    the recordings, from their input alone, certainly worse than another, each beside its `filters`. A law that the
    times show is compared in this with such laws only: while physics is missing, an input that acts sooner or later
    makes up for some of it.
    """
    held, _ = refitted[HELD]
    from_rows = {law: (_under_law(problem, law), this) for law, (problem, this) in refitted.items()}
    under = {law: (replace(problem, noise=held.noise), this) for law, (problem, this) in from_rows.items()}
    loss = {law: losses_beside(*under[law], (filters or {}).get(law, ())) for law in scores}

    def is_believable(law: str) -> bool:
        against = [other for other in scores if INTERSAMPLE[other].shown or not INTERSAMPLE[law].shown]
        best = min(against, key=lambda other: float(np.mean(loss[other])))
        return loss_gained(loss[best], loss[law]) < CERTAINLY

    believable = [law for law in scores if law == HELD or is_believable(law)]
    shown = [law for law in believable if INTERSAMPLE[law].shown and scores[law] > scores[HELD] + DECISIVE]
    usual = max(shown, key=lambda law: scores[law], default=HELD)
    others = [law for law in believable if not INTERSAMPLE[law].shown]
    decisive = [law for law in others if is_decisive(scores[law] - scores[usual], statistics(*refitted[law]))]
    return max(decisive, key=lambda law: scores[law], default=usual)


def _all_explained(
    explanation: Fit, under: Mapping[str, Problem], filters: Sequence[SensorFilter] = ()
) -> dict[str, tuple[Problem, Fit]]:
    def beside(problem: Problem) -> tuple[Problem, Fit]:
        return under_own_noise(explanation, filtered(_input_inferred(problem, explanation, filters), filters))

    found = side_by_side(beside, under.values())
    return dict(zip(under, found, strict=True))


def _input_inferred(problem: Problem, explanation: Fit, filters: Sequence[SensorFilter]) -> Problem:
    """A problem under a law, with what no row shows of the input as the motion tells beside filters.

    Steps that fell between two rows are errors under the right law too, where all that is known of them is how high.
    """
    if not has_unknown_input(problem):
        return problem
    for _ in range(rounds(problem)):
        told = with_inferred_input(*under_own_noise(explanation, filtered(problem, filters)))
        acted = zip(problem.runs, told.runs, strict=True)
        problem = replace(problem, runs=tuple(replace(run, applied_input=t.applied_input) for run, t in acted))
    return problem


def _leading(refitted: Mapping[str, tuple[Problem, Fit]]) -> set[str]:
    """The law under which an explanation is likeliest, and that under which it errs least."""
    noise = refitted[HELD][0].noise

    def error(law: str) -> float:
        problem, this = refitted[law]
        return float(np.mean(losses_of(replace(problem, noise=noise), this)))

    def likelihood(law: str) -> float:
        problem, this = refitted[law]
        return log_posterior(problem, this) - log_density(problem)

    return {max(refitted, key=likelihood), min(refitted, key=error)}


def _candidates(problem: Problem) -> dict[str, Problem]:
    """The problem under each law by which the input acted otherwise than held, and as held.

    Not under one by which most of a signal is not known: between values that are held there is nothing to interpolate.
    """
    under = {law: _under_law(problem, law) for law in INTERSAMPLE}
    acting = {law: p for law, p in under.items() if any(r.applied_input is not None for r in p.runs)}
    return {HELD: under[HELD]} | {law: p for law, p in acting.items() if law == HELD or _is_known(p, under[HELD])}


def _is_known(problem: Problem, held: Problem) -> bool:
    """Whether most of what is compared under a held input is under another law."""
    return all(
        np.sum(~run.not_compared(s)) > MOST_OFF * np.sum(~other.not_compared(s))
        for run, other in zip(problem.runs, held.runs, strict=True)
        for s in run.recorded
    )


def without_unknown(recordings: Sequence[Recording], model: Model) -> list[Recording]:
    """The recordings without currents that depend on when the input changed since the row before, which no row shows.

    A winding follows its voltage within a row or two. Where the voltage stepped at any instant of that interval, evenly
    likely, the current has a variance of a twelfth of the square of what it will become. Raises InputError where a
    recording does not fit the model.
    """
    recordings, law = list(recordings), model.recording.intersample
    if law in (AUTO, HELD) or not model.drive.winding or any("current" not in r.signals for r in recordings):
        return recordings
    problem, _ = nominal_of(recordings, model)
    known_to = model.drive.resting_voltage(model.motor, CERTAIN * problem.noise["current"].deviation)  # [V]
    for k, run in enumerate(problem.runs):
        after = np.diff(clock_of(run.time).ticks, prepend=0) > 1 if law == "bridged" else np.full(run.time.size, True)
        off = after & (np.abs(np.diff(run.input, prepend=run.input[:1])) / np.sqrt(12.0) > known_to)
        if off.mean() < MOST_OFF:
            missing = recordings[k].missing
            lost = {"current": off | missing.get("current", np.zeros(off.size, dtype=bool))}
            recordings[k] = replace(recordings[k], missing={**missing, **lost})
    return recordings


def without_untimed(recordings: Sequence[Recording], model: Model) -> list[Recording]:
    """The recordings without the currents that hang on when a row beside a clock's ticks was taken, for any law.

    A few that were taken while the current rose would decide between all laws, by what none of them says.
    """
    beside_a_clock = any(clock_beside(r.time) is not None for r in recordings)
    return without_unknown(recordings, stating(model, "ticks")) if beside_a_clock else list(recordings)


def stating(model: Model, law: str) -> Model:
    """The model with a law in its recordings' layout."""
    return replace(model, recording=replace(model.recording, intersample=law))


def _under_law(problem: Problem, law: str) -> Problem:
    return replace(problem, runs=tuple(r.with_intersample(law) for r in problem.runs))
