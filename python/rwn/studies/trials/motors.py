"""Brushed DC motors from 1 W to 500 W: round figures of industrial machines, then scattered."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rwn.studies.trials.plant import Values


@dataclass(frozen=True)
class Motor:
    """SI units; `coulomb_friction` is usual for this size, and used where the nominal model has it."""

    name: str
    voltage: float
    resistance: float
    inductance: float
    torque_constant: float
    inertia: float
    viscous_friction: float
    coulomb_friction: float

    @property
    def time_constant(self) -> float:
        """Mechanical time constant R J / (Kt Ke) [s]."""
        return self.resistance * self.inertia / self.torque_constant**2

    def nominal(self, *, dry: bool) -> Values:
        """The values that a model file gives; Coulomb friction only where `dry`."""
        values = {
            "resistance": self.resistance,
            "inductance": self.inductance,
            "torque_constant": self.torque_constant,
            "back_emf_constant": self.torque_constant,
            "inertia": self.inertia,
            "viscous_friction": self.viscous_friction,
        }
        return values | ({"coulomb_friction": self.coulomb_friction} if dry else {})


# name, V, ohm, H, N m/A, kg m^2, N m s/rad, N m
MOTORS = (
    Motor("M01-1W-6V", 6.0, 13.0, 1.5e-3, 0.0041, 4.8e-8, 4e-8, 4e-5),
    Motor("M02-3W-12V", 12.0, 11.0, 2.0e-3, 0.0115, 4.6e-7, 1.8e-7, 2e-4),
    Motor("M03-6W-24V", 24.0, 19.0, 3.6e-3, 0.0260, 1.2e-6, 3e-7, 5e-4),
    Motor("M04-10W-12V", 12.0, 2.4, 9.5e-4, 0.0190, 1.7e-6, 1.6e-6, 8e-4),
    Motor("M05-20W-24V", 24.0, 2.3, 2.6e-4, 0.0230, 5.0e-6, 1e-6, 2e-3),
    Motor("M06-40W-24V", 24.0, 1.1, 4.5e-4, 0.0370, 2.9e-5, 6e-6, 5e-3),
    Motor("M07-60W-24V", 24.0, 0.62, 1.2e-4, 0.0265, 7.8e-6, 7e-6, 3.5e-3),
    Motor("M08-90W-24V", 24.0, 0.47, 7.2e-4, 0.0500, 1.1e-4, 2e-5, 1e-2),
    Motor("M09-120W-36V", 36.0, 0.68, 1.5e-3, 0.0780, 2.8e-4, 3e-4, 1.6e-2),
    Motor("M10-180W-48V", 48.0, 0.80, 1.5e-3, 0.1230, 3.8e-4, 6e-5, 2.5e-2),
    Motor("M11-250W-24V", 24.0, 0.12, 2.4e-4, 0.0680, 1.4e-3, 1e-4, 4e-2),
    Motor("M12-350W-90V", 90.0, 1.10, 4.6e-3, 0.2950, 8.6e-4, 2.6e-4, 5.5e-2),
    Motor("M13-500W-48V", 48.0, 0.18, 7.3e-4, 0.1330, 5.4e-3, 2.4e-4, 8e-2),
)


def draw_motor(rng: np.random.Generator) -> Motor:
    """One of the table, each value of it off by a random factor of the order of 10 % (dry friction: 30 %)."""
    motor = MOTORS[int(rng.integers(len(MOTORS)))]
    spread = {
        "resistance": 0.06,
        "inductance": 0.1,
        "torque_constant": 0.05,
        "inertia": 0.1,
        "viscous_friction": 0.4,
        "coulomb_friction": 0.3,
    }
    changed: dict[str, Any] = {
        name: float(getattr(motor, name) * np.exp(width * rng.standard_normal()))
        for name, width in spread.items()
    }
    return replace(motor, **changed)


def plant_of(nominal: Values) -> Values:
    """Plant parameters of a nominal model."""
    plant = {name: value for name, value in nominal.items() if name != "coulomb_friction"}
    if "coulomb_friction" in nominal:
        plant["coulomb_plus"] = plant["coulomb_minus"] = nominal["coulomb_friction"]
    return plant
