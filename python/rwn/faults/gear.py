"""The ratio of a wrong gear, fitted once it is known what physics is missing beneath it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rwn.faults.fault import Mistake, without
from rwn.faults.scale import gear
from rwn.fit.preparation import prepare
from rwn.model.model import Model
from rwn.name.forward import Explanation
from rwn.name.screening import Search
from rwn.recording.recording import Recording

REACH = 0.3  # relative error of a ratio that was read off the size of a signal
EXACT = 2e-3  # relative accuracy that is asked for


def gear_ratio(mistake: Mistake, recordings: Sequence[Recording], model: Model, beneath: Explanation) -> Mistake:
    """`mistake` with the ratio at which the explanation beneath it, priors included, costs least.

    `recordings` are those with the mistake. The ratio is known as well as Ke is: only their product shows.
    """
    from scipy.optimize import minimize_scalar  # late: the command line starts without it

    def tried(change: float) -> Mistake:
        return gear(mistake.signals, mistake.factor * float(np.exp(change)), mistake.spread)

    def cost(change: float) -> float:
        setup = prepare(without(recordings, tried(change)), model)
        known = beneath.setup.problem
        noise = replace(mistake, factor=float(np.exp(change))).levels(known.noise)  # on top of what is undone already
        problem = replace(setup.problem, noise=noise, colour=known.colour)
        return Search.of(setup, problem=problem).refit(beneath.closest, problem).cost

    end = minimize_scalar(cost, bounds=(-REACH, REACH), method="bounded", options={"xatol": EXACT})
    return tried(float(end.x)) if end.fun < cost(0.0) else mistake
