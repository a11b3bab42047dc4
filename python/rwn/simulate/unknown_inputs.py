"""The torque and the voltage that the equations leave over along the recorded motion, as signals."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from rwn import _core
from rwn.model.drives.drive import Drive
from rwn.model.vocabulary import motor_values
from rwn.recording.smoothing import smooth
from rwn.simulate.run import Run
from rwn.simulate.simulator import Simulator

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class UnknownInputs:
    """What the equations leave over on one recording, (n,) each in SI, smoothed over at most 31 samples."""

    time: Array
    speed: Array
    acceleration: Array
    current: Array  # zeros where it is neither recorded nor part of the drive
    angle: Array  # [rad]; 2 pi per metre of a linear axis
    torque: Array  # drives positive rotation [N m]
    voltage: Array  # drop in the winding [V]; empty where current was not recorded
    lacking: Literal["torque", "voltage"] = "torque"  # which of the two the mismatch is located in

    @property
    def mismatch(self) -> Array:
        """The input (n,) that is lacking."""
        return self.voltage if self.lacking == "voltage" else self.torque


def unknown_inputs(
    drive: Drive, simulator: Simulator, run: Run, vector: Array, active: Sequence[int] = ()
) -> UnknownInputs:
    """Inverse dynamics along the recorded motion (n,), under the effects that are `active`.

    They are what the equations of cpp/include/rwn/model/motor.hpp lack on their right sides. With voltage and speed
    alone the current is at rest with the speed, so both carry the mismatch. A transfer function has no torque: its
    place is taken by the error of the output; `vector` then holds the state at the start of the run.
    """
    speed, acceleration = run.motion
    none = np.zeros(speed.size)
    if drive.coefficients:
        left = simulator.simulate(run, vector, active).signals["speed"]
        return UnknownInputs(
            time=run.time, speed=speed, acceleration=acceleration, current=none, angle=none,
            torque=run.speed - left, voltage=np.empty(0),
        )  # fmt: skip
    length = run.smoothing_length  # the same for all signals: then the linear equations still hold
    given = np.ascontiguousarray(smooth(run.input, length))
    current = smooth(run.current, length) if run.current.size else np.empty(0)
    torque, voltage = along_motion(
        simulator, vector, active, time=run.time, driven=given, position=run.angle if run.angle.size else none,
        speed=speed, acceleration=acceleration, current=current,
    )  # fmt: skip
    if drive.winding and not current.size:
        current = drive.resting_current(motor_values(vector), speed, given)
    return UnknownInputs(
        time=run.time,
        speed=speed,
        acceleration=acceleration,
        current=current if current.size else none,
        angle=simulator.angle_per_position * run.angle if run.angle.size else none,
        torque=torque,
        voltage=voltage,
    )


def along_motion(
    simulator: Simulator, vector: Array, active: Sequence[int], *, time: Array, driven: Array, position: Array,
    speed: Array, acceleration: Array, current: Array,
) -> tuple[Array, Array]:  # fmt: skip
    """Torque and voltage (n,) that the equations leave over along a motion under the input `driven`, (n,) each.

    An empty `current` is at rest with the speed, and the voltage is empty then.
    """
    slope = np.gradient(current, time) if current.size else current
    task = simulator.given_input(np.ascontiguousarray(time), np.ascontiguousarray(driven))
    motion = {"speed": speed, "position": position, "acceleration": acceleration, "current": current}
    arrays = {name: np.ascontiguousarray(x) for name, x in (motion | {"current_slope": slope}).items()}
    parameters = vector[: _core.parameter_count()]  # no start of a run counts here
    left = _core.unknown_inputs(task, parameters, list(active), **arrays)
    return left.torque, left.voltage
