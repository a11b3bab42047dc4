"""What an identification says of a model that lacks something."""

from __future__ import annotations

import rwn
from made_up_motor import MOTOR, recorded

MODEL = rwn.Model(kind="dc", parameters=MOTOR, uncertainty={"inertia": 0.2, "viscous_friction": 0.5})


def test_what_is_left_that_is_not_noise_is_said() -> None:
    assert not rwn.identify([recorded(2, lambda *_: 0.0)], MODEL).warnings
    lacking = rwn.identify([recorded(2, lambda speed, _: -1e-5 * speed * abs(speed))], MODEL)
    assert not lacking.failure
    (said,) = lacking.warnings
    assert said.startswith("what is left of the current and speed is not noise: the model lacks something")


def test_it_prints_its_values() -> None:
    found = rwn.identify([recorded(2, lambda *_: 0.0)], MODEL)
    first, *values = str(found).splitlines()
    assert first == repr(found)
    assert [line.split(" = ")[0].strip() for line in values] == list(found.parameters)
    assert values[0].endswith("kg m^2")
