"""How the input acted between the rows, read off the recordings: the law under which what is left is likeliest."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from rwn.fit.fit import Fit, fit_nominal, refit
from rwn.fit.likelihood import DECISIVE, log_likelihood
from rwn.fit.noise import with_noise_of
from rwn.fit.preparation import prepare
from rwn.fit.problem import Problem
from rwn.model.model import Model
from rwn.parallel import side_by_side
from rwn.recording.columns import Intersample
from rwn.recording.recording import Recording
from rwn.simulate.intersample import HELD, INTERSAMPLE

ITERATIONS = 8  # of a fit that begins near its end


def with_intersample(recordings: Sequence[Recording], model: Model) -> Model:
    """The model with the law that is likeliest under its refitted nominal structure, unless it states one.

    Raises InputError where a recording does not fit the model.
    """
    if model.recording.intersample != "auto" or model.drive.coefficients:
        return model
    problem = prepare(recordings, stating(model, HELD))
    problem = with_noise_of(problem, fit_nominal(problem))
    return stating(model, _likeliest(problem, fit_nominal(problem)))


def intersample_beside(problem: Problem, this: Fit) -> Intersample:
    """The law that is likeliest under a fit; that of the problem where none is by far."""
    return _likeliest(problem, this)


def stating(model: Model, law: Intersample) -> Model:
    """The model with a law in its recordings' layout."""
    return replace(model, recording=replace(model.recording, intersample=law))


def _likeliest(problem: Problem, this: Fit) -> Intersample:
    scores = _log_likelihoods(problem, this)
    best = max(scores, key=lambda law: scores[law])
    return best if scores[best] > scores[HELD] + DECISIVE else HELD


def _log_likelihoods(problem: Problem, this: Fit) -> Mapping[Intersample, float]:
    """Of a fit repeated under every law that says something else than "held" of these recordings."""
    under = {law: _under(problem, law) for law in INTERSAMPLE}
    told = {law: p for law, p in under.items() if law == HELD or any(r.acting.size for r in p.runs)}
    found = side_by_side(lambda p: log_likelihood(p, refit(this, p, iterations=ITERATIONS)), told.values())
    return dict(zip(told, found, strict=True))


def _under(problem: Problem, law: Intersample) -> Problem:
    return replace(
        problem,
        runs=tuple(r.with_intersample(law) for r in problem.runs),
        whole=tuple(r.with_intersample(law) for r in problem.whole),
    )
