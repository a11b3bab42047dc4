"""Fits where the error is rough: a contact met a little earlier changes all that follows, and derivatives mislead.

Steps without derivatives over the parameters of the effect that makes it so (Nelder, Mead 1965, over their logarithms)
take turns with steps along the derivatives over all of them.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rwn.candidate import Candidate, fit
from rwn.least_squares import Minimum
from rwn.output_error import OutputError

Array = NDArray[np.float64]

EVALUATIONS = 80  # simulations of a turn without derivatives
ITERATIONS = 12  # of a turn with them
FIRST = 0.22  # first steps without derivatives, relative
GAIN = 2e-3  # least relative gain in cost that is worth another turn


def rough(this: Candidate) -> list[int]:
    """The unknowns of effects that idealise a contact; empty where the error is smooth."""
    owners = {name for name in this.effects if any(p.idealised for p in this.table[name].parameters)}
    return [k for k, u in enumerate(this.unknowns) if u.name.partition(".")[0] in owners and u.lower > 0.0]


def settled(problem: OutputError, this: Candidate, start: Minimum, *, turns: int) -> Minimum:
    """The fit of `this` from the end of another, by turns as long as they gain; `start` where its error is smooth."""
    best = start
    for _ in range(turns if rough(this) else 0):
        values = _without_derivatives(problem, this, best.values)
        again = fit(problem, this.starting_at(values), max_iterations=ITERATIONS)
        gained = again.cost < (1.0 - GAIN) * best.cost
        best = min(best, again, key=lambda m: m.cost)
        if not gained:
            break
    return best


def _without_derivatives(problem: OutputError, this: Candidate, values: Array) -> Array:
    from scipy.optimize import minimize  # late: the command line starts without it

    where = rough(this)
    lower, upper = (np.log([getattr(this.unknowns[k], side) for k in where]) for side in ("lower", "upper"))

    def put(z: Array) -> Array:
        moved = values.copy()
        moved[where] = np.exp(np.clip(z, lower, upper))
        return moved

    def error(z: Array) -> float:
        return problem.error(this.with_values(put(z)), this.active)

    first = np.log(values[where])
    corners = np.vstack([first, first - FIRST * np.eye(len(where))])
    found = minimize(
        error, first, method="Nelder-Mead", options={"initial_simplex": corners, "maxfev": EVALUATIONS}
    )
    return put(found.x)
