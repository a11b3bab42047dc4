"""The quantities that parameters are measured against, so that one table of bounds fits every size of motor."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rwn.model.drives.drive import Drive
from rwn.model.vocabulary import motor_values
from rwn.simulate.run import Run
from rwn.simulate.simulator import Simulator

Array = NDArray[np.float64]

LEAST = 1e-12  # in place of a quantity that recordings do not show, or that a drive does not have
RATES = ((1e-6, 1e-3), (1.0, 1e6))  # time step and duration [s] of the fastest and the longest recording


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


def scales_of_input(run: Run, drive: Drive, simulator: Simulator, vector: Array) -> list[dict[str, float]]:
    """The scales that the input of a run shows through the motor alone; none of a motor that runs away.

    `vector`: parameters (all,). Also as they would be of a briefer, a longer and a denser recording: a run that is
    simulated may be so beside those that its model was fitted to.
    """
    output = simulator.simulate(run, vector, [])
    if output.status != "ok":
        return []
    found = scales(drive, vector, [run], [output.signals])
    return [found, *({**found, "time_step": step, "duration": duration} for step, duration in RATES)]


def under_usual_input(run: Run, drive: Drive, vector: Array) -> Run:
    """The run with a usual input instead of its own, which may be much weaker; nothing of it was recorded.

    `vector`: parameters (all,).
    """
    usual = np.full(run.input.size, drive.usual_input(motor_values(vector)))
    nothing = np.empty(0)
    return replace(run, input=usual, applied_input=None, current=nothing, speed=nothing, position=nothing)


def _best(run: Run, output: dict[str, Array], signal: str) -> Array:
    recorded = run.signal(signal)
    return recorded if recorded.size else output[signal]


def _peak(signal: Array) -> float:
    return float(np.percentile(np.abs(signal), 99.5)) if signal.size else 0.0
