"""Where a network may stand for what has no name."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

import rwn
from made_up_motor import MOTOR, plant
from rwn.fit.preparation import prepare
from rwn.unnamed_law.network_formula import parts_of
from rwn.unnamed_law.places import places

SHEET = rwn.Model(kind="dc", parameters=MOTOR, uncertainty={"viscous_friction": 0.3})


def test_a_voltage_that_never_changes_is_no_state() -> None:
    """Its range made numbers such as 8e+300 in the network's own formula."""
    voltage = np.full(600, 8.0)
    rows = plant(voltage, lambda w, _: -2e-6 * w * abs(w))
    signals = {"voltage": voltage, "current": rows[:, 0], "speed": rows[:, 1]}
    problem = prepare([rwn.Recording(name="step.csv", time=1e-3 * np.arange(600), signals=signals)], SHEET)
    found = places(problem, SHEET)
    assert "input" not in {place.state for place in found}
    for place in found:  # every formula can be read
        assert parts_of(problem, replace(SHEET), place, 7)
