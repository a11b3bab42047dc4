"""How far a simulation is off what its recording holds."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rwn.recording.inspection import inspected
from rwn.recording.recording import Recording
from rwn.recording.signals import MEASURED
from rwn.simulate.simulation import Simulation


class RecordedError(NamedTuple):
    """Of one signal, over the samples that measure something: no spikes, nothing that is held between updates."""

    rms: float  # in SI
    left_out: int  # samples that measure nothing


def recorded_errors(run: Simulation, recording: Recording) -> dict[str, RecordedError]:
    """The error of each signal that was recorded and simulated, by name."""
    (checked,), _ = inspected([recording])
    errors = {}
    for signal in (s for s in MEASURED if s in run.signals and s in recording.signals):
        missing = checked.missing.get(signal, np.zeros(len(recording), dtype=bool))
        if not missing.all():
            left = (recording.signals[signal] - run.signals[signal])[~missing]
            errors[signal] = RecordedError(rms=float(np.sqrt(np.mean(left**2))), left_out=int(missing.sum()))
    return errors
