"""The state of a transfer function at the first sample of a run, where it is not at rest: what fits the run best."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from rwn.model.vocabulary import state_indices
from rwn.recording.noise import Noise
from rwn.simulate.run import Run
from rwn.simulate.simulator import Simulator

Array = NDArray[np.float64]

ITERATIONS = 12
_NONE: Mapping[str, Noise] = MappingProxyType({})


def nearest_state(
    simulator: Simulator, run: Run, vector: Array, active: Sequence[int], *, noise: Mapping[str, Noise] = _NONE,
    starts: Sequence[Array] | None = None, prior: Array | None = None,
) -> Array:  # fmt: skip
    """`vector` with the initial state that fits the run best, from the best of several `starts` (order,).

    `prior`: (order, order) weight of the state against the squared error; `noise`: see Simulator.
    """
    index = state_indices(simulator.order)
    weight = np.zeros((simulator.order, simulator.order)) if prior is None else prior

    def descended(start: Array) -> tuple[float, Array]:
        """Gauss-Newton on the initial state alone: one step where the sensor is linear."""
        best, here, at = np.inf, vector.copy(), start
        for _ in range(ITERATIONS):
            trial = vector.copy()
            trial[index] = at
            normal = simulator.normal_equations(run, trial, active, index, noise=noise)
            cost = normal.chi2 + float(at @ weight @ at)
            if not normal.finite or not np.isfinite(cost) or cost >= best - 1e-6 * abs(best):
                break
            best, here = cost, trial
            sizes = np.diag(normal.curvature + weight)
            if not sizes.any() or not np.isfinite(normal.curvature).all():
                break  # the recording does not depend on the state, or the run leaves the finite numbers
            scale = 1.0 / np.sqrt(np.maximum(sizes, 1e-12 * sizes.max()))
            system = (normal.curvature + weight) * np.outer(scale, scale) + 1e-9 * np.eye(simulator.order)
            at = at + scale * np.linalg.solve(system, scale * (normal.gradient - weight @ at))
        return best, here

    found = [descended(start) for start in starts or [np.zeros(simulator.order)]]
    return min(found, key=lambda pair: pair[0])[1]
