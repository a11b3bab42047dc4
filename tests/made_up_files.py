"""Recordings of one made-up motor, of which a parameter or the load is another in each."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

import rwn
from rwn.model.model import Model


def files_of(
    model: Model, names: Sequence[str], factors: Sequence[float], samples: int = 600, *, loads: Sequence[float] = ()
) -> list[rwn.Recording]:
    """One noisy recording, run_0 and so on, for each factor on the parameters `names`; `loads` [N m] of each."""
    made, rng, time = [], np.random.default_rng(3), 1e-3 * np.arange(samples)
    for k, factor in enumerate(factors):
        motor = {**model.parameters, **{name: factor * model.parameters[name] for name in names}}
        voltage = np.repeat(rng.uniform(-3.0, 3.0, samples // 50), 50)
        run = rwn.Recording(name=f"run_{k}", time=time, signals={"voltage": voltage})
        hanging = {"constant-load": {"torque": loads[k]}} if loads else {}
        shown = rwn.simulate(replace(model, parameters=motor, effects={**model.effects, **hanging}), run).signals
        noisy = {s: shown[s] + level * rng.standard_normal(samples) for s, level in (("current", 0.01), ("speed", 0.3))}
        made.append(replace(run, signals={"voltage": voltage, **noisy}))
    return made
