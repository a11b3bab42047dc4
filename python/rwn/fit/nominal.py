"""The nominal model refitted, with what it leaves as the noise of the signals: where every search begins."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rwn import _core
from rwn.errors import NoResultError
from rwn.fit.fit import Fit, fit_nominal
from rwn.fit.levenberg_marquardt import FitStatus
from rwn.fit.preparation import prepare
from rwn.fit.problem import Problem
from rwn.fit.residual_noise import with_noise_of
from rwn.model.model import Model
from rwn.recording.recording import Recording

Array = NDArray[np.float64]

EPSILON = float(np.finfo(float).eps)


def weighted_by_nominal(problem: Problem) -> tuple[Problem, Fit]:
    """The problem weighted by the noise that the refitted nominal model leaves, and that model refitted under it."""
    problem = with_noise_of(problem, fit_nominal(problem))
    return problem, fit_nominal(problem)


def nominal_of(recordings: Sequence[Recording], model: Model) -> tuple[Problem, Fit]:
    """The problem of recordings, weighted by the noise that the refitted nominal model leaves, and that model.

    Raises InputError where a recording does not fit the model.
    """
    return weighted_by_nominal(prepare(recordings, model))


def check_it_begins(problem: Problem) -> None:
    """Raises NoResultError where the model as given cannot be simulated over a recording: no fit begins there.

    Nor where it runs away so far that rounding leaves nothing of what was recorded in the error.
    """
    this, free = problem.as_given(), problem.in_free_run()
    _check_simulations(free, this.vector, this.active, "the model as given")
    for run, left in zip(free.runs, free.residuals(this.vector, this.active), strict=True):
        if any(np.max(np.abs(x)) * EPSILON > np.max(np.abs(run.signal(s))) for s, x in left.items()):
            raise NoResultError("diverged", FitStatus.DIVERGED.value, where=f"{run.name}, the model as given")


def check_it_runs(problem: Problem, nominal: Fit) -> None:
    """Raises NoResultError where the refitted nominal model cannot be simulated over a recording.

    Nothing that is compared with it would be a number.
    """
    _check_simulations(problem.in_free_run(), nominal.vector, nominal.active, "the refitted model")
    if nominal.minimum.status is FitStatus.DIVERGED:
        raise NoResultError("diverged", FitStatus.DIVERGED.value, where="the refitted model")


def _check_simulations(free: Problem, vector: Array, active: Sequence[int], which: str) -> None:
    for run in free.runs:
        made = free.simulate(run, vector, active)
        shown = [made.signals[name] for name in free.drive.outputs]
        finite = all(np.isfinite(values).all() for values in shown)  # a sensor's law may overflow by itself
        status = made.status if finite or made.status != "ok" else "diverged"
        if status != "ok":
            raise NoResultError(status, _core.simulation_advice(status), where=f"{run.name}, {which}")
