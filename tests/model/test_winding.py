"""What a drive with a winding says of it: the equations of the core, of numbers and of arrays."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from rwn.model.drives.axis import AXIS
from rwn.model.drives.dc import DC
from rwn.model.drives.winding import WindingDrive

MOTOR = {"resistance": 0.8, "inductance": 1.5e-3, "torque_constant": 0.1, "back_emf_constant": 0.11}
ANSWERS: dict[str, tuple[Callable[..., object], float]] = {
    "torque of 3 A": (lambda x: DC.driving_torque(MOTOR, x, x), 0.1 * 3.0),
    "voltage of 3 A": (lambda x: DC.resting_voltage(MOTOR, x), 0.8 * 3.0),
    "back-EMF of 3 rad/s": (lambda x: DC.back_emf(MOTOR, x), 0.11 * 3.0),
    "current at 3 rad/s and 3 V": (lambda x: DC.resting_current(MOTOR, x, x), (3.0 - 0.11 * 3.0) / 0.8),
}


@pytest.mark.parametrize("asked", ANSWERS)
def test_numbers_and_arrays_have_one_answer(asked: str) -> None:
    answer, expected = ANSWERS[asked]
    assert answer(3.0) == expected
    for shape in [(4,), (4, 2), (0,)]:
        found = answer(np.full(shape, 3.0))
        assert isinstance(found, np.ndarray)
        assert found.shape == shape
        assert (found == expected).all()


def test_what_brakes_and_what_warms() -> None:
    assert DC.speed_damping(MOTOR) == 0.1 * 0.11 / 0.8
    assert DC.heat(MOTOR, 9.0) == 0.8 * 9.0


def test_a_kind_has_to_say_what_its_winding_is() -> None:
    kind = WindingDrive(kind="new", input="voltage", outputs=("speed", "current"), parameters=())
    assert kind.winding
    with pytest.raises(NotImplementedError, match="a new does not say"):
        kind.back_emf(MOTOR, 1.0)
    with pytest.raises(NotImplementedError, match="no winding"):
        AXIS.back_emf(MOTOR, 1.0)
