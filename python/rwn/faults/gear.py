"""The ratio of a wrong gear, fitted once it is known what physics is missing beneath it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rwn.faults.fault import Fault, without
from rwn.faults.scale import gear
from rwn.fit.fit import refit
from rwn.fit.preparation import prepare
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
        problem = prepare(without(recordings, tried(change)), model)
        known = beneath.problem
        more = replace(fault, factor=float(np.exp(change)))  # on top of what is undone already
        noise = more.noise_without(known.noise)
        return refit(beneath.closest, replace(problem, noise=noise, inflation=known.inflation)).cost

    end = minimize_scalar(cost, bounds=(-REACH, REACH), method="bounded", options={"xatol": RATIO_TOLERANCE})
    return tried(float(end.x)) if end.fun < cost(0.0) else fault
