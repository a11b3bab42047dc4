"""Whether a recorded speed and a recorded position are of one motion: no model is needed to tell."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rwn.recording.recording import Recording

Array = NDArray[np.float64]

ONE_MOTION = 0.99  # correlation below which nothing is said; what lacks to it bends the ratio by less than 2 %
CONTRADICTS = 0.05  # difference of the ratio from 1 from which it is said: sensors of 2 % differ by less


class Kinematics(NamedTuple):
    """The speed over the rate at which the position changes, and how alike the two motions are."""

    ratio: float  # negative where they run against each other
    correlation: float

    @property
    def contradict(self) -> bool:
        """Whether the two cannot both be right."""
        return abs(self.correlation) > ONE_MOTION and abs(self.ratio - 1.0) > CONTRADICTS

    @property
    def agree(self) -> bool:
        """Whether each says that the other is right."""
        return self.correlation > ONE_MOTION and not self.contradict


def kinematics_of(recording: Recording) -> Kinematics | None:
    """Of the speed added up over time against the position; None without both, or where either stands still.

    A start anywhere and a bias of the speed (a line in its sum) are taken out of both. A position that wraps, or that
    is of a shaft on a spring, is unlike the sum, and nothing is said of it.
    """
    if not {"speed", "position"} <= set(recording.signals):
        return None
    time, speed = recording.time - recording.time[0], np.asarray(recording.signals["speed"])
    turned = np.concatenate([[0.0], np.cumsum(0.5 * (speed[1:] + speed[:-1]) * np.diff(time))])
    both = np.stack([turned, np.asarray(recording.signals["position"])], axis=1)
    line = np.stack([np.ones(time.size), time], axis=1)
    left = both - line @ np.linalg.lstsq(line, both, rcond=None)[0]
    sizes = np.sqrt(np.sum(left**2, axis=0))
    if np.any(sizes <= np.finfo(float).eps * np.sqrt(time.size) * np.max(np.abs(both), axis=0)):
        return None
    correlation = float(left[:, 0] @ left[:, 1] / np.prod(sizes))
    return Kinematics(float(np.copysign(sizes[0] / sizes[1], correlation)), correlation)
