"""Free-run simulation of a model over a recording's input."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rwn import _core
from rwn.fit.hypothesis import candidate
from rwn.fit.preparation import prepare
from rwn.fit.problem import SIGNALS
from rwn.model.model import Model
from rwn.recording.recording import Recording

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Simulation:
    """Simulated signals at the recording's instants, SI, (n_t,) each, as the recording's sensors would show them."""

    time: Array
    signals: Mapping[str, Array]
    status: str
    advice: str


def simulate(model: Model, recording: Recording) -> Simulation:
    """Simulates `model` from the input signal of `recording` alone.

    The state at the first sample is rest or what the recording shows, as the model's `[recording]` table says.
    """
    setup = prepare([recording], model)
    this = candidate(setup.nominal, (), setup.scales)
    output = setup.whole.simulate(setup.whole.targets[0], this.vector, this.active)
    wanted = [name for name in SIGNALS if name in model.drive.outputs]
    return Simulation(
        time=recording.time,
        signals={name: output.signals[name] for name in wanted},
        status=output.status,
        advice=_core.simulation_advice(output.status),
    )
