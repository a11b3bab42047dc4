"""A current that is not the winding's."""

from __future__ import annotations

import numpy as np
import pytest

import rwn
from made_up_motor import MOTOR
from rwn.recording.inspection import inspected
from rwn.recording.recording import Recording

TIME = np.arange(3000) * 1e-3


def _driven(*, stepped: bool, load: float = 0.0) -> Recording:
    rng = np.random.default_rng(1)
    held = np.repeat(rng.uniform(-10.0, 10.0, TIME.size // 30), 30)
    voltage = held if stepped else 8.0 * np.sin(40.0 * TIME)
    effects = {"constant-load": {"torque": load}} if load else {}
    bare = Recording(name="run.csv", time=TIME, signals={"voltage": voltage})
    shown = rwn.simulate(rwn.Model(kind="dc", parameters=MOTOR, effects=effects), bare).signals
    noisy = shown["current"] + 0.02 * rng.standard_normal(TIME.size)
    return Recording(name="run.csv", time=TIME, signals={"voltage": voltage, "speed": shown["speed"], "current": noisy})


def _having(recording: Recording, current: np.ndarray) -> Recording:
    return Recording(name="run.csv", time=TIME, signals={**recording.signals, "current": current})


@pytest.mark.parametrize("stepped", [True, False])
@pytest.mark.parametrize("load", [0.0, -0.3])
def test_a_current_of_the_winding_is_none_of_a_supply(stepped: bool, load: float) -> None:
    """Nor is one that holds a load, and has one sign."""
    assert "supply-current" not in {f.kind for f in inspected([_driven(stepped=stepped, load=load)]).findings}


def test_a_current_of_the_supply_or_a_rectified_one_is_said() -> None:
    run = _driven(stepped=True)
    current, voltage = run.signals["current"], run.signals["voltage"]
    for shown in (current * voltage / 24.0, np.abs(current)):
        (left,), found = inspected([_having(run, shown)])
        assert set(left.signals) == {"voltage", "speed"}
        (said,) = (f for f in found if f.kind == "supply-current")
        assert said.signals == ("current",)
        assert "supply" in said.words
