"""The drive's linear answer to a torque: J dr/dt + (B + D) r = T for a speed r, D its `speed_damping`."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rwn.model.drives.drive import Drive
from rwn.model.vocabulary import motor_values

Array = NDArray[np.float64]


def speed_filter(drive: Drive, vector: Array, step: float) -> tuple[float, float]:
    """(a, b) of r[k] = a r[k-1] + b T[k-1], the speed's answer [rad/s] to a torque [N m] held over a step [s].

    `vector`: parameters (all,), SI.
    """
    motor = motor_values(vector)
    inertia, damping = motor["inertia"], motor["viscous_friction"] + drive.speed_damping(motor)
    rate = max(damping / inertia, 1e-9)
    a = float(np.exp(-rate * step))
    return a, (1.0 - a) / (rate * inertia)
