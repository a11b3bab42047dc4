"""Windows for multiple shooting: short simulations one after the other, each from the motion that was recorded."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rwn.simulate.run import Run

WINDOW = 50  # samples of a window of a drive that integrates: short enough that drift does not drown the forces


def windowed(run: Run, length: int = WINDOW) -> Run:
    """The same recording in windows of `length` samples, each starting from the smoothed recorded motion.

    As it is where that cannot be (`can_restart`).
    """
    if not run.can_restart:
        return run
    speed, position = run.motion[0], run.angle
    return replace(
        run,
        restart_every=length,
        restart_speed=np.ascontiguousarray(speed),
        restart_position=np.ascontiguousarray(position),
        start=(0.0, float(speed[0]), float(position[0])),
        start_spread={},
    )
