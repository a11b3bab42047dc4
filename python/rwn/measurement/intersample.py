"""How the input acted between the rows, read off the recordings: the law under which what is left is likeliest."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from statistics import NormalDist

import numpy as np
from numpy.typing import NDArray

from rwn.fit.fit import NEAR_ITS_END, Fit, refit
from rwn.fit.nominal import nominal_of
from rwn.fit.problem import Problem
from rwn.fit.refitting import under_own_noise
from rwn.fit.residuals import LEVEL, loss_gained, statistics
from rwn.measurement.filter_colour import SensorFilter
from rwn.measurement.known_filters import filtered
from rwn.measurement.likelihood import DECISIVE, is_decisive, log_likelihood, log_posterior
from rwn.measurement.sensor_filter import filters_and_likelihood, losses_beside, losses_of
from rwn.model.initial_state import CERTAIN
from rwn.model.model import Model
from rwn.parallel import side_by_side
from rwn.recording.clock import clock_of
from rwn.recording.intersample import AUTO, HELD, INTERSAMPLE
from rwn.recording.recording import Recording, beginnings

Array = NDArray[np.float64]

CERTAINLY = NormalDist().inv_cdf(1.0 - LEVEL)  # standard deviations by which a law has to simulate worse to be refused
MOST_OFF = 0.5  # share of the rows of a signal that may be unknown: with more, little of it is left to be compared


def with_intersample(recordings: Sequence[Recording], model: Model) -> Model:
    """The model with the law that is likeliest under its refitted nominal structure, unless it states one.

    Raises InputError where a recording does not fit the model.
    """
    if model.recording.intersample != AUTO or model.drive.coefficients:
        return model
    return stating(model, likeliest(*nominal_of(beginnings(recordings), stating(model, HELD))))


def likeliest(problem: Problem, this: Fit) -> str:
    """The law under which the errors of a fit, refitted, are likeliest; one that the rows' times do not show, by far.

    What is new in an error may go with the input by another way than through the drive: a controller answers the noise
    of a row by the input of that row, a cable picks its steps up. A law that foretells this is likelier for no physics,
    so one that simulates the recordings certainly worse than another, from their input alone, is not taken.
    """
    candidates = _candidates(problem)
    fits = side_by_side(lambda p: refit(this, p, iterations=NEAR_ITS_END), candidates.values())
    refitted = dict(zip(candidates, zip(candidates.values(), fits, strict=True), strict=True))
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
        asked |= _leading(_all_explained(explanation, {law: filtered(p, known) for law, p in candidates.items()}))
    if len(asked) == 1:
        return HELD, tuple(known)
    found = {law: filters_and_likelihood(*refitted[law], known) for law in sorted(asked)}
    filters = {law: of_law for law, (of_law, _) in found.items()}
    law = _chosen(refitted, {law: likelihood for law, (_, likelihood) in found.items()}, filters)
    return law, filters[law]


def _chosen(
    refitted: Mapping[str, tuple[Problem, Fit]], scores: Mapping[str, float],
    filters: Mapping[str, Sequence[SensorFilter]] | None = None,
) -> str:  # fmt: skip
    """The likeliest law, "held" where none is decisively so; of one that no times show, by what is left is worth.

    One that simulates the recordings certainly worse than another, each beside its `filters`, is neither. Against one
    that the times show, one that no times show does not count: while physics is missing, an input that acts sooner or
    later makes up for some of it.
    """
    held, _ = refitted[HELD]
    under = {law: (replace(problem, noise=held.noise), this) for law, (problem, this) in refitted.items()}
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


def _all_explained(explanation: Fit, under: Mapping[str, Problem]) -> dict[str, tuple[Problem, Fit]]:
    found = side_by_side(lambda p: under_own_noise(explanation, p), under.values())
    return dict(zip(under, found, strict=True))


def _leading(refitted: Mapping[str, tuple[Problem, Fit]]) -> set[str]:
    """The law under which an explanation is likeliest, and that under which it errs least."""
    noise = refitted[HELD][0].noise

    def error(law: str) -> float:
        problem, this = refitted[law]
        return float(np.mean(losses_of(replace(problem, noise=noise), this)))

    return {max(refitted, key=lambda law: log_posterior(*refitted[law])), min(refitted, key=error)}


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
    """The recordings without the currents that hang on when the input changed since the row before, which none knows.

    A winding follows its voltage within a row or two: where that stepped, evenly spread over the step, the current is
    known to a twelfth of the square of what it will become.
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


def stating(model: Model, law: str) -> Model:
    """The model with a law in its recordings' layout."""
    return replace(model, recording=replace(model.recording, intersample=law))


def _under_law(problem: Problem, law: str) -> Problem:
    return replace(problem, runs=tuple(r.with_intersample(law) for r in problem.runs))
