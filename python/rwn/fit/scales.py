"""The quantities that parameters are measured against, so that one table of bounds fits every size of motor."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rwn.model.drives.drive import Drive
from rwn.model.vocabulary import motor_values
from rwn.simulate.run import Run

Array = NDArray[np.float64]


def scales(
    drive: Drive, motor: Array, runs: Sequence[Run], outputs: Sequence[dict[str, Array]]
) -> dict[str, float]:
    """Value (SI) of each quantity of `Scale`: from the motor's parameters (all,), runs and nominal outputs (n,)."""
    known = motor_values(motor)
    step = float(np.median(np.concatenate([np.diff(r.time) for r in runs])))
    given = max(_peak(r.input) for r in runs)
    current = max(_peak(_best(r, o, "current")) for r, o in zip(runs, outputs, strict=True))
    speed = max(_peak(_best(r, o, "speed")) for r, o in zip(runs, outputs, strict=True))
    torque = drive.driving_torque(known, current, given)
    speed = max(speed, 1e-12)
    duration = max(float(r.time[-1] - r.time[0]) for r in runs)
    squares = [np.mean(_best(r, o, "current") ** 2) for r, o in zip(runs, outputs, strict=True)]
    loss = max(drive.heat(known, float(np.max(squares))), 1e-12)
    return {
        "torque": max(torque, 1e-12),
        "speed": speed,
        "voltage": max(given, 1e-12),
        "current": max(current, 1e-12),
        "inertia": known["inertia"],
        "time_step": step,
        "duration": duration,
        "loss": loss,
    }


def _best(run: Run, output: dict[str, Array], signal: str) -> Array:
    recorded = run.signal(signal)
    return recorded if recorded.size else output[signal]


def _peak(signal: Array) -> float:
    return float(np.percentile(np.abs(signal), 99.5)) if signal.size else 0.0
