"""The quantities that parameters are measured against, so that one table of bounds fits every size of motor."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rwn.model.drives.drive import Drive
from rwn.model.vocabulary import motor_values
from rwn.simulate.run import Run
from rwn.simulate.simulator import Simulator

Array = NDArray[np.float64]

LEAST = 1e-12  # in place of a quantity that recordings do not show, or that a drive does not have
USUAL_STEPS, USUAL_ROWS = (2e-4, 0.02), 1000  # time steps [s] and rows of a fast and of a long recording


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
    speed = max(speed, LEAST)
    duration = max(float(r.time[-1] - r.time[0]) for r in runs)
    squares = [np.mean(_best(r, o, "current") ** 2) for r, o in zip(runs, outputs, strict=True)]
    loss = max(drive.heat(known, float(np.max(squares))), LEAST)
    return {
        "torque": max(torque, LEAST),
        "speed": speed,
        "voltage": max(given, LEAST),
        "current": max(current, LEAST),
        "inertia": known["inertia"],
        "time_step": step,
        "duration": duration,
        "loss": loss,
    }


def scales_of_input(runs: Sequence[Run], drive: Drive, simulator: Simulator, vector: Array) -> list[dict[str, float]]:
    """The scales that the inputs of runs show through the motor alone; none of a motor that runs away.

    `vector`: parameters (all,).
    """
    outputs = [simulator.simulate(run, vector, []) for run in runs]
    if any(output.status != "ok" for output in outputs):
        return []
    return [scales(drive, vector, runs, [output.signals for output in outputs])]


def usual_scales(drive: Drive, simulator: Simulator, vector: Array) -> list[dict[str, float]]:
    """The scales that a drive shows when it is run from rest with a usual input: by rows of a fast and of a long run.

    `vector`: parameters (all,).
    """
    given = np.full(USUAL_ROWS, drive.usual_input(motor_values(vector)))
    times = [step * np.arange(USUAL_ROWS, dtype=np.float64) for step in USUAL_STEPS]
    runs = [Run(name="usual", time=time, input=given) for time in times]
    both = scales_of_input(runs, drive, simulator, vector)
    return [{**one, "time_step": float(t[1]), "duration": float(t[-1])} for one in both for t in times]


def _best(run: Run, output: dict[str, Array], signal: str) -> Array:
    recorded = run.signal(signal)
    return recorded if recorded.size else output[signal]


def _peak(signal: Array) -> float:
    return float(np.percentile(np.abs(signal), 99.5)) if signal.size else 0.0
