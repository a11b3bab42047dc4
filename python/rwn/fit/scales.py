"""The quantities that parameters are measured against, so that one table of bounds fits every size of motor."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rwn.fit.problem import Target
from rwn.model.vocabulary import motor_index

Array = NDArray[np.float64]


def scales(
    kind: str, motor: Array, targets: Sequence[Target], outputs: Sequence[dict[str, Array]]
) -> dict[str, float]:
    """Value of each `Scale` (SI) from the motor's parameter vector, the recordings and their nominal simulation."""
    inertia = motor[motor_index("inertia")]
    step = float(np.median(np.concatenate([np.diff(t.time) for t in targets])))
    drive = max(_peak(t.input) for t in targets)
    current = max(_peak(_best(t, o, "current")) for t, o in zip(targets, outputs, strict=True))
    speed = max(_peak(_best(t, o, "speed")) for t, o in zip(targets, outputs, strict=True))
    torque = motor[motor_index("torque_constant")] * current if kind == "dc" else drive
    speed = max(speed, 1e-12)
    duration = max(float(t.time[-1] - t.time[0]) for t in targets)
    squares = [np.mean(_best(t, o, "current") ** 2) for t, o in zip(targets, outputs, strict=True)]
    loss = max(motor[motor_index("resistance")] * float(np.max(squares)), 1e-12)
    return {
        "none": 1.0,
        "torque": max(torque, 1e-12),
        "speed": speed,
        "voltage": max(drive, 1e-12),
        "current": max(current, 1e-12),
        "inertia": inertia,
        "damping": torque / speed,
        "stiffness": inertia * (0.3 / step) ** 2,
        "drag": torque / speed**2,
        "time_step": step,
        "duration": duration,
        "loss": 1.0 / loss,
        "heat": loss * duration,
    }


def _best(target: Target, output: dict[str, Array], signal: str) -> Array:
    recorded = target.signal(signal)
    return recorded if recorded.size else output[signal]


def _peak(signal: Array) -> float:
    return float(np.percentile(np.abs(signal), 99.5)) if signal.size else 0.0
