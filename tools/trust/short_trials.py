"""Trials of a sine in place of a simulated bench, for what asks about files alone; processes of a pool load this."""

from __future__ import annotations

import numpy as np

from rwn.studies.trials.bench import Recording
from rwn.studies.trials.conceal import Nominal
from rwn.studies.trials.plan import Plan
from rwn.studies.trials.trial import Trial

MOTOR = {"resistance": 0.8, "torque_constant": 0.1, "back_emf_constant": 0.1, "inertia": 3e-4}
ROWS = 400


def short_trial(plan: Plan) -> Trial:
    """The trial of a plan, another one for each."""
    time = np.arange(ROWS) * 1e-3
    noise = np.random.default_rng((plan.seed, plan.index)).normal(size=ROWS)
    sine = Recording(time, 5.0 * np.sin(40.0 * time), 40.0 * np.sin(40.0 * time - 0.7) + noise)
    return Trial(Nominal(MOTOR, {"inertia": 0.1}), (sine, sine), (sine,), {"effects": list(plan.effects)})
