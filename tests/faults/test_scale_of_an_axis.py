"""The scale of an axis's force is judged against all that the model as given needs for the motion."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from rwn.faults.fault import UNIT
from rwn.faults.scale import wrong_scale


@pytest.fixture(scope="module")
def model() -> rwn.Model:
    """An axis that is little but dry friction."""
    motor = {"inertia": 1e-3, "viscous_friction": 1e-4, "coulomb_friction": 0.5}
    return rwn.Model(kind="axis", parameters=motor, uncertainty={"inertia": 0.1})


@pytest.fixture(scope="module")
def right(model: rwn.Model) -> rwn.Recording:
    time = 1e-3 * np.arange(4000)
    torque = 0.6 * np.sin(2.0 * np.pi * time) * np.sign(np.sin(np.pi * time))
    given = rwn.Recording(name="right", time=time, signals={"torque": torque})
    return replace(given, signals={"torque": torque, "speed": rwn.simulate(model, given).signals["speed"]})


def test_a_right_force_has_no_fault(right: rwn.Recording, model: rwn.Model) -> None:
    assert wrong_scale([right], model) is None


def test_a_wrong_unit_of_the_force_is_found_behind_friction_that_the_model_knows(
    right: rwn.Recording, model: rwn.Model
) -> None:
    """What accelerates it is a small part of its force, which inertia and viscous friction alone do not account for."""
    wrong = replace(right, signals={**right.signals, "torque": 1e3 * right.signals["torque"]})
    found = wrong_scale([wrong], model)
    assert found is not None
    assert (found.name, found.signals, found.factor) == (UNIT, ("torque",), 1e3)
