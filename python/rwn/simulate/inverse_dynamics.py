"""The equation error of an axis: recorded driving force against the force that the model needs for the motion.

Filters as in the identification of robots (Gautier 1997; Janot, Gautier, Brunot 2019 for EMPS): position through a
zero-phase 100 Hz Butterworth filter of order 4, central differences, then both sides through the same decimation.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rwn import _core
from rwn.fit.problem import OutputError, Target

Array = NDArray[np.float64]
CUTOFF = 100.0  # [Hz]
DECIMATION = 10
EDGE = 50  # samples at either end that the filters spoil


def force_error(
    problem: OutputError, target: Target, vector: Array, active: list[int]
) -> tuple[Array, Array]:
    """(error, driving force), decimated; empty where no position is recorded or the recording is too short."""
    from scipy.signal import butter, decimate, filtfilt  # late: scipy takes half a second to load

    step = float(np.median(np.diff(target.time)))
    if not target.position.size or target.time.size < 20 * EDGE:
        return np.empty(0), np.empty(0)
    b, a = butter(4, min(2.0 * CUTOFF * step, 0.8))
    position = np.ascontiguousarray(filtfilt(b, a, target.position))
    speed = np.gradient(position, step)
    needed = _core.inverse_dynamics(
        vector, active, problem.angle_per_position, target.time, position, speed, np.gradient(speed, step),
        problem.own,
    )
    inner = slice(EDGE, -EDGE)
    force = decimate(target.input[inner], DECIMATION)
    return force - decimate(needed[inner], DECIMATION), force
