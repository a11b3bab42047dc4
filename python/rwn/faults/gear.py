"""The ratio of a wrong gear, fitted once it is known what physics is missing beneath it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rwn.faults.fault import Fault, without
from rwn.faults.scale import gear
from rwn.fit.fit import refit
from rwn.fit.preparation import prepare
from rwn.fit.problem import Problem
from rwn.model.model import Model
from rwn.name.ranking import Ranking
from rwn.recording.recording import Recording

REACH = 0.3  # relative error of a ratio that was read off the size of a signal
RATIO_TOLERANCE = 2e-3  # relative accuracy of a gear ratio that is asked for


def gear_ratio(fault: Fault, recordings: Sequence[Recording], model: Model, beneath: Ranking) -> Fault:
    """`fault` with the ratio at which the explanation beneath it, priors included, costs least.

    `recordings` are those with the fault. The ratio is known as well as Ke is: only their product shows.
    """
    from scipy.optimize import minimize_scalar  # late: the command line starts without it

    def tried(change: float) -> Fault:
        return gear(fault.signals, fault.factor * float(np.exp(change)), fault.spread)

    def cost(change: float) -> float:
        return refit(beneath.closest, _geared(fault, tried(change).factor, recordings, model, beneath)).cost

    end = minimize_scalar(cost, bounds=(-REACH, REACH), method="bounded", options={"xatol": RATIO_TOLERANCE})
    return tried(float(end.x)) if end.fun < cost(0.0) else fault


def is_needless(
    fault: Fault, fitted: Fault, recordings: Sequence[Recording], model: Model, beneath: Ranking, plain: Ranking
) -> bool:  # fmt: skip
    """Whether `plain`, found of the recordings as they are, explains them as well as what is beneath the gear.

    Where physics was missing a gear may have stood in for it: beneath it Ke is then off by as much. `fault`: the gear
    that was undone when the physics beneath it was found, and `fitted` with that.
    """

    def cost(ratio: float, found: Ranking) -> float:
        return refit(found.closest, _geared(fault, ratio, recordings, model, beneath)).cost

    return cost(1.0, plain) <= cost(fitted.factor, beneath)


def _geared(
    fault: Fault, ratio: float, recordings: Sequence[Recording], model: Model, beneath: Ranking
) -> Problem:  # fmt: skip
    """The recordings with another ratio undone, and their noise in the units of that."""
    undone = without(recordings, gear(fault.signals, ratio, fault.spread)) if ratio != 1.0 else recordings
    more = replace(fault, factor=ratio / fault.factor)  # on top of what is undone already
    problem, known = prepare(undone, model), beneath.problem
    return replace(problem, noise=more.noise_without(known.noise), inflation=known.inflation)
