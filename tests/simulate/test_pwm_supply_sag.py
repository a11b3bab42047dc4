"""A bridge that passes on the sag of its supply: a resistance that grows with the square of the duty."""

from __future__ import annotations

import numpy as np
import pytest

import rwn

SUPPLY, SOURCE = 12.0, 0.12  # V, ohm


@pytest.mark.parametrize("volts", [12.0, 3.0, -9.0])
def test_it_is_the_resistance_of_the_supply_by_the_square_of_the_duty(volts: float) -> None:
    motor = {"resistance": 0.4, "inductance": 5e-4, "torque_constant": 0.02, "back_emf_constant": 0.02}
    shaft = {"inertia": 5e-5, "viscous_friction": 2e-5, "coulomb_friction": 10.0}  # held
    model = rwn.Model(
        kind="dc", parameters=motor | shaft, effects={"pwm-supply-sag": {"sag": SOURCE / SUPPLY**2}}
    )
    run = rwn.Recording(name="run", time=np.arange(200) * 1e-3, signals={"voltage": np.full(200, volts)})
    resistance = motor["resistance"] + SOURCE * (volts / SUPPLY) ** 2
    current = rwn.simulate(model, run).signals["current"]
    assert current[-1] == pytest.approx(volts / resistance, rel=1e-6)
    rising = 1.0 - np.exp(-resistance / motor["inductance"] * run.time)
    assert current == pytest.approx(rising * volts / resistance, rel=1e-4, abs=1e-6)
