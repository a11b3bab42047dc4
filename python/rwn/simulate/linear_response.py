"""The drive's linear answer to a torque: J dr/dt + (B + Kt Ke / R) r = T for a speed r."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rwn.model.drives.drive import Drive
from rwn.model.vocabulary import motor_index

Array = NDArray[np.float64]


def speed_filter(drive: Drive, vector: Array, step: float) -> tuple[float, float]:
    """(a, b) of r[k] = a r[k-1] + b T[k-1], the speed's answer to a torque held over a step [s]."""
    inertia, damping = vector[motor_index("inertia")], vector[motor_index("viscous_friction")]
    if drive.winding:
        coupling = vector[motor_index("torque_constant")] * vector[motor_index("back_emf_constant")]
        damping += coupling / vector[motor_index("resistance")]
    rate = max(damping / inertia, 1e-9)
    a = float(np.exp(-rate * step))
    return a, (1.0 - a) / (rate * inertia)
