"""The nominal model refitted, with what it leaves as the noise of the signals: where every search begins."""

from __future__ import annotations

from collections.abc import Sequence

from rwn.fit.fit import Fit, fit_nominal
from rwn.fit.noise import with_noise_of
from rwn.fit.preparation import prepare
from rwn.fit.problem import Problem
from rwn.model.model import Model
from rwn.recording.recording import Recording


def weighted_by_nominal(problem: Problem) -> tuple[Problem, Fit]:
    """The problem weighted by the noise that the refitted nominal model leaves, and that model refitted under it."""
    problem = with_noise_of(problem, fit_nominal(problem))
    return problem, fit_nominal(problem)


def nominal_of(recordings: Sequence[Recording], model: Model) -> tuple[Problem, Fit]:
    """The same of recordings. Raises InputError where one does not fit the model."""
    return weighted_by_nominal(prepare(recordings, model))
