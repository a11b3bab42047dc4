"""The places at which a network may stand for a law that has no name."""

from __future__ import annotations

import numpy as np
import pytest

import rwn
from made_up_motor import MOTOR
from rwn.fit.preparation import prepare
from rwn.fit.problem import Problem
from rwn.model.model import Model
from rwn.unnamed_law.network_formula import parts_of
from rwn.unnamed_law.places import all_places, places, size_of

TIME = 1e-3 * np.arange(2000)
SHAFT = Model(kind="dc", parameters=MOTOR, uncertainty={"viscous_friction": 0.3})
AXIS = Model(
    kind="axis", parameters={"inertia": 80.0, "viscous_friction": 200.0}, uncertainty={"inertia": 0.1}, linear=True
)
RUNS = {
    "dc": {"voltage": 6.0 + 3.0 * np.sin(20.0 * TIME), "current": np.sin(9.0 * TIME), "speed": 60.0 + 20.0 * TIME},
    "axis": {"force": 50.0 * np.sin(9.0 * TIME), "position": 0.1 * np.sin(9.0 * TIME)},
}


def problem_of(model: Model) -> Problem:
    return prepare([rwn.Recording(name="run.csv", time=TIME, signals=RUNS[model.kind])], model)


@pytest.mark.parametrize("model", [SHAFT, AXIS], ids=["shaft", "linear axis"])
def test_every_formula_has_its_units(model: Model) -> None:
    problem = problem_of(model)
    for place in all_places(problem, model):
        (part,) = parts_of(problem, model, place, 7)  # refused where the units do not work out
        assert part.term == place.term
        assert size_of(problem, place) > 0.0


def test_laws_of_several_states_and_of_a_sensor_have_a_place() -> None:
    found = {(p.term, p.factor, p.state, p.periods) for p in all_places(problem_of(SHAFT), SHAFT)}
    assert ("torque", "", "position", 0) in found, "a spring at the load"
    assert ("torque", "current", "time", 0) in found, "magnets that warm up"
    assert ("friction", "", "time", 0) in found, "a friction level that drifts"
    assert ("speed", "speed", "position", 1) in found, "an eccentric encoder"


def test_a_correction_is_of_the_drive_and_over_what_it_meets_again() -> None:
    for model in (SHAFT, AXIS):
        found = places(problem_of(model), model)
        assert {"torque", "friction"} <= {p.term for p in found}
        assert not any(p.of_a_sensor or p.state == "time" for p in found)


def test_what_is_not_there_has_no_place() -> None:
    axis = all_places(problem_of(AXIS), AXIS)
    assert not {"drop", "current"} & {p.term for p in axis}
    assert not {"current"} & {p.state for p in axis}
    assert not any(p.periods for p in axis), "a linear axis does not go round"


def test_a_state_that_one_sample_alone_changes_has_no_place() -> None:
    """A range of nothing made numbers beyond all bounds of the wavelets over it."""
    time = 1e-3 * np.arange(5000)
    signals = {"voltage": np.append(np.zeros(time.size - 1), 1e-6), "speed": 60.0 + 20.0 * time}
    problem = prepare([rwn.Recording(name="run.csv", time=time, signals=signals)], SHAFT)
    assert not any("input" in (p.state, p.factor) for p in all_places(problem, SHAFT))
