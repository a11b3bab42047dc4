"""The motor that the plant's tests turn, and the commands that turn it."""

from __future__ import annotations

import numpy as np

from rwn.studies.trials.effects import EFFECTS
from rwn.studies.trials.motors import MOTORS, plant_of

RATE = 1000.0
MOTOR = next(motor for motor in MOTORS if motor.name == "M06-40W-24V")
NOMINAL = MOTOR.nominal(dry=False)
J, B, KT, R = (
    NOMINAL["inertia"],
    NOMINAL["viscous_friction"],
    NOMINAL["torque_constant"],
    NOMINAL["resistance"],
)
TIME = np.arange(100) / RATE
BOTH_WAYS = np.round(
    5.0 * np.sin(2.0 * np.pi * 9.0 * TIME) + 2.0 * np.sin(2.0 * np.pi * 41.0 * TIME + 0.4), 5
)
FORWARD = np.round(6.0 + 2.0 * np.sin(2.0 * np.pi * 30.0 * TIME), 5)  # never turns back


def built(name: str, values: dict[str, float]) -> dict[str, float]:
    """Plant parameters of the motor with this effect."""
    dry = name == "presliding-hysteresis"
    nominal = NOMINAL | ({"coulomb_friction": 0.005} if dry else {})
    return plant_of(nominal) | EFFECTS[name].build(values, nominal)
