"""The equation error of an axis: recorded driving force against the force that the model needs for the motion.

Filters as in the identification of robots (Gautier 1997; Janot, Gautier, Brunot 2019 for EMPS): position through a
zero-phase 100 Hz Butterworth filter of order 4, central differences, then both sides through the same decimation.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rwn.simulate.run import Run
from rwn.simulate.simulator import Simulator
from rwn.simulate.unknown_inputs import along_motion

Array = NDArray[np.float64]
CUTOFF = 100.0  # [Hz]
DECIMATION = 10
EDGE = 50  # samples at either end that the filters spoil


def needed_force(
    simulator: Simulator, vector: Array, active: Sequence[int], *, time: Array, position: Array, speed: Array,
    acceleration: Array,
) -> Array:  # fmt: skip
    """Driving torque [N m] or force [N] (n,) that an axis needs for a given motion (n,), in SI."""
    force, _ = along_motion(
        simulator, vector, active, time=time, driven=np.zeros(time.size), position=position, speed=speed,
        acceleration=acceleration, current=np.empty(0),
    )  # fmt: skip
    return force


def force_error(simulator: Simulator, run: Run, vector: Array, active: Sequence[int]) -> tuple[Array, Array]:
    """Error and driving force (n,) [N m or N], decimated; empty without a position, or of too short a recording."""
    from scipy.signal import butter, decimate, filtfilt  # late: scipy takes half a second to load

    step = run.sample_time
    if not run.position.size or run.time.size < 20 * EDGE:
        return np.empty(0), np.empty(0)
    b, a = butter(4, min(2.0 * CUTOFF * step, 0.8))
    position = np.ascontiguousarray(filtfilt(b, a, run.position))
    speed = np.gradient(position, step)
    needed = needed_force(
        simulator, vector, active, time=run.time, position=position, speed=speed,
        acceleration=np.gradient(speed, step),
    )  # fmt: skip
    inner = slice(EDGE, -EDGE)
    force = decimate(run.input[inner], DECIMATION)
    return force - decimate(needed[inner], DECIMATION), force
