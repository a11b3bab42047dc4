"""The angle of the shaft at the first sample of a run, where nothing tells it: what fits the run best.

A motor that turned before its recording began, with no position recorded, may have begun it at any angle.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from rwn.model.initial_state import INITIAL_POSITION
from rwn.model.vocabulary import Effect, motor_index
from rwn.recording.noise import Noise
from rwn.simulate.run import Run
from rwn.simulate.simulator import Simulator

Array = NDArray[np.float64]

OF_A_PERIOD = 12  # angles tried of the shortest period: the best of them is within a twentieth of a period
MOST_ANGLES = 240  # of a revolution
ITERATIONS = 6
_NONE: Mapping[str, Noise] = MappingProxyType({})


def angles_to_try(effects: Iterable[Effect], vector: Array) -> Array:
    """Angles (k,) [rad] of which one is near any other, for effects of the angle; none without such an effect.

    `vector`: the parameters (all,), which hold the periods of each per revolution.
    """
    orders = {
        max([1.0, *(float(vector[effect.at(p.name)]) for p in effect.every if p.order)])
        for effect in effects
        if effect.turns
    }
    if not orders:
        return np.empty(0)
    longest = max(orders) if len(orders) == 1 else 1.0  # periods of a revolution after which all come round again
    count = min(int(np.ceil(OF_A_PERIOD * max(orders) / longest)), MOST_ANGLES)
    return np.linspace(0.0, 2.0 * np.pi / longest, count, endpoint=False)


def nearest_angle(
    simulator: Simulator, run: Run, vector: Array, active: Sequence[int], *, angles: Array,
    noise: Mapping[str, Noise] = _NONE,
) -> Array:  # fmt: skip
    """`vector` (all,) with the angle at the first sample that fits the run best, begun from the best of `angles` (k,).

    `noise`: see Simulator.
    """
    where = motor_index(INITIAL_POSITION)

    def at(angle: float) -> Array:
        trial = vector.copy()
        trial[where] = angle
        return trial

    def error(angle: float) -> float:
        found = simulator.normal_equations(run, at(angle), active, (), noise=noise)
        return found.chi2 if found.finite and np.isfinite(found.chi2) else np.inf

    if not angles.size:
        return vector
    best = float(min(angles, key=error))
    least = error(best)
    for _ in range(ITERATIONS):
        normal = simulator.normal_equations(run, at(best), active, [where], noise=noise)
        if not normal.finite or not normal.curvature[0, 0] > 0.0:
            break
        trial = best + float(normal.gradient[0] / normal.curvature[0, 0])
        if not (cost := error(trial)) < least:
            break
        best, least = trial, cost
    return at(best)
