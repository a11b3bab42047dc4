"""The nominal model refitted, with what it leaves as the noise of the signals: where every search begins."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rwn import _core
from rwn.errors import NoResultError
from rwn.fit.fit import Fit, fit_nominal
from rwn.fit.preparation import prepare
from rwn.fit.problem import Problem
from rwn.fit.residual_noise import with_noise_of
from rwn.model.model import Model
from rwn.recording.recording import Recording


def weighted_by_nominal(problem: Problem) -> tuple[Problem, Fit]:
    """The problem weighted by the noise that the refitted nominal model leaves, and that model refitted under it."""
    problem = with_noise_of(problem, fit_nominal(problem))
    return problem, fit_nominal(problem)


def nominal_of(recordings: Sequence[Recording], model: Model) -> tuple[Problem, Fit]:
    """The problem of recordings, weighted by the noise that the refitted nominal model leaves, and that model.

    Raises InputError where a recording does not fit the model.
    """
    return weighted_by_nominal(prepare(recordings, model))


def check_it_runs(problem: Problem, nominal: Fit) -> None:
    """Raises NoResultError where the refitted nominal model cannot be simulated over a recording.

    Nothing that is compared with it would be a number.
    """
    free = problem.in_free_run()
    for run in free.runs:
        made = free.simulate(run, nominal.vector, nominal.active)
        shown = [made.signals[name] for name in free.drive.outputs]
        finite = all(np.isfinite(values).all() for values in shown)  # a sensor's law may overflow by itself
        status = made.status if finite or made.status != "ok" else "diverged"
        if status != "ok":
            raise NoResultError(status, _core.simulation_advice(status), where=f"{run.name}, the refitted model")
