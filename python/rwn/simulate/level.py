"""The level of a quantity in a recording that was not fitted, where it differs from one to the next: what fits it best.

As the angle at its start, it is a number of that recording and none of the machine.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from rwn.recording.noise import Noise
from rwn.simulate.run import Run
from rwn.simulate.simulator import Simulator

Array = NDArray[np.float64]

ITERATIONS = 6
HALVINGS = 4


def nearest_level(
    simulator: Simulator, run: Run, vector: Array, active: Sequence[int], *, parameters: Sequence[int], spread: float,
    noise: Mapping[str, Noise],
) -> Array:  # fmt: skip
    """`vector` (all,) with `parameters` times the one factor at which the run fits best.

    `spread`: prior deviation of its logarithm. `noise`: see Simulator.
    """
    scaled = [p for p in parameters if vector[p] != 0.0]

    def at(level: float) -> Array:
        trial = vector.copy()
        trial[scaled] *= np.exp(level)
        return trial

    def cost(level: float) -> float:
        found = simulator.normal_equations(run, at(level), active, (), noise=noise)
        chi2 = found.chi2 if found.finite and np.isfinite(found.chi2) else np.inf
        return chi2 + (level / spread) ** 2

    best, least = 0.0, cost(0.0)
    for _ in range(ITERATIONS if scaled else 0):
        here = at(best)
        normal = simulator.normal_equations(run, here, active, scaled, noise=noise)
        along = here[scaled]
        curvature = float(along @ normal.curvature @ along) + 1.0 / spread**2
        if not normal.finite or not np.isfinite(curvature):
            break
        step = (float(along @ normal.gradient) - best / spread**2) / curvature
        trials = ((best + share * step, cost(best + share * step)) for share in 0.5 ** np.arange(HALVINGS))
        level, found = next((pair for pair in trials if pair[1] < least), (best, least))
        if not found < least:
            break
        best, least = level, found
    return at(best)
