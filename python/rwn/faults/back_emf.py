"""What the winding says of the scale of the speed: its back-EMF is as large as the shaft turns fast."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rwn.fit.residuals import correlation_time
from rwn.model.initial_state import CERTAIN
from rwn.model.model import Model
from rwn.recording.recording import Recording
from rwn.recording.smoothing import smooth
from rwn.simulate.recorded_run import run_of


@dataclass(frozen=True, kw_only=True)
class BackEmf:
    """Back-EMF per recorded speed in units of what the model has, with its standard deviation; nothing: 0 +- inf."""

    ratio: float = 0.0
    deviation: float = np.inf

    def denies(self, factor: float) -> bool:
        """Whether a speed that is recorded `factor` times too large would have another back-EMF than was seen.

        That is so where the one that was seen is nearer to that of the speed as it was recorded.
        """
        if not self.ratio > CERTAIN * self.deviation:
            return False
        return bool(factor < 0.0 or abs(np.log(self.ratio)) < 0.5 * abs(np.log(factor)))


def back_emf(recordings: Sequence[Recording], model: Model) -> BackEmf:
    """By least squares over all recordings: voltage = R i + L di/dt + Ke w + offset, with R, L and the ratio free."""
    rows, given = [], []
    for recording in recordings if model.drive.winding else ():
        run = run_of(recording, model)
        if not (run.current.size and run.speed.size):
            return BackEmf()
        current, speed = (smooth(x, run.smoothing_length) for x in (run.current, run.speed))
        columns = (
            model.drive.resting_voltage(model.motor, current), np.gradient(current, run.time),
            model.drive.back_emf(model.motor, speed), np.ones(current.size),
        )  # fmt: skip
        rows.append(np.column_stack(columns))
        given.append(smooth(run.input, run.smoothing_length))
    if not rows:
        return BackEmf()
    design, voltage = np.concatenate(rows), np.concatenate(given)
    scale = np.maximum(np.linalg.norm(design, axis=0), 1e-300)
    found, _, rank, _ = np.linalg.lstsq(design / scale, voltage, rcond=None)
    if rank < design.shape[1]:
        return BackEmf()
    left = voltage - design / scale @ found
    spread = float(left @ left) / max(left.size - rank, 1) * correlation_time(left)
    covariance = np.linalg.inv((design / scale).T @ (design / scale)) * spread
    return BackEmf(ratio=float(found[2] / scale[2]), deviation=float(np.sqrt(covariance[2, 2]) / scale[2]))
