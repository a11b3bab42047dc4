"""Levels of quantities in a recording that was not fitted, where they differ from one to the next: what fits it best.

As the angle at its start, they are numbers of that recording and none of the machine.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from rwn.recording.noise import Noise
from rwn.simulate.own_unknowns import LevelPrior
from rwn.simulate.run import Run
from rwn.simulate.simulator import Simulator

Array = NDArray[np.float64]

ITERATIONS = 6
HALVINGS = 4


def nearest_levels(
    simulator: Simulator, run: Run, vector: Array, active: Sequence[int], levels: Sequence[LevelPrior], *,
    noise: Mapping[str, Noise],
) -> Array:  # fmt: skip
    """`vector` (all,) with the levels, (k,) of them, at which the run fits best. `noise`: see Simulator."""
    changed = [[p for p in level.parameters if level.adds or vector[p] != 0.0] for level in levels]
    wanted = sorted({p for of in changed for p in of})
    spreads = np.array([level.spread for level in levels])

    def at(values: Array) -> Array:
        trial = vector.copy()
        for level, of, value in zip(levels, changed, values, strict=True):
            trial[of] = level.of(trial[of], value)
        return trial

    def cost(values: Array) -> float:
        found = simulator.normal_equations(run, at(values), active, (), noise=noise)
        chi2 = found.chi2 if found.finite and np.isfinite(found.chi2) else np.inf
        return chi2 + float(np.sum((values / spreads) ** 2))

    best = np.zeros(len(levels))
    least = cost(best)
    for _ in range(ITERATIONS if wanted else 0):
        here = at(best)
        normal = simulator.normal_equations(run, here, active, wanted, noise=noise)
        if not normal.finite or not np.isfinite(normal.curvature).all():
            break
        along = np.zeros((len(wanted), len(levels)))
        for j, (level, of) in enumerate(zip(levels, changed, strict=True)):
            along[[wanted.index(p) for p in of], j] = 1.0 if level.adds else here[of]
        curvature = along.T @ normal.curvature @ along + np.diag(1.0 / spreads**2)
        step = np.linalg.solve(curvature, along.T @ normal.gradient - best / spreads**2)
        trials = ((best + share * step, cost(best + share * step)) for share in 0.5 ** np.arange(HALVINGS))
        values, found = next((pair for pair in trials if pair[1] < least), (best, least))
        if not found < least:
            break
        best, least = values, found
    return at(best)
