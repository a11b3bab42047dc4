"""Declared effects that no drive of this size can have, though the sign of their values is right."""

from __future__ import annotations

from contextlib import nullcontext
from dataclasses import replace

import numpy as np
import pytest

import rwn
from made_up_motor import MOTOR as MADE_UP
from rwn.errors import InputError
from rwn.fit.preparation import prepare
from rwn.model.vocabulary import table
from rwn.simulate.declared import check_declared
from rwn.simulate.scales import LEAST

MOTOR = rwn.Model(kind="dc", parameters=MADE_UP)
TIME = np.arange(300) * 1e-3
STALL = 0.1 * 6.0 / 0.8  # N m, the torque of the drive at 6 V


def _run(volts: float = 6.0) -> rwn.Recording:
    voltage = volts * np.sin(30.0 * TIME)
    recording = rwn.Recording(name="run", time=TIME, signals={"voltage": voltage})
    return replace(recording, signals={"voltage": voltage, **rwn.simulate(MOTOR, recording).signals})


@pytest.mark.parametrize(
    ("effect", "values"),
    [
        ("coulomb-friction", {"coulomb_torque": 1e4}),
        ("quadratic-drag", {"drag_coefficient": 1.0}),
        ("viscous-friction", {"damping": 1e12}),  # a search before would overflow
        ("coulomb-friction", {"coulomb_torque": 101.0 * STALL}),
    ],
)  # fmt: skip
@pytest.mark.parametrize("ask", [rwn.identify, rwn.diagnose])
def test_a_value_that_no_such_drive_has_is_refused(ask: object, effect: str, values: dict[str, float]) -> None:
    assert {p.name for p in table()[effect].parameters} == set(values)
    model = replace(MOTOR, effects={effect: values})
    (name,) = values
    with pytest.raises(InputError, match=rf"\[effects.{effect}\]: {name} is .*; fix: "):
        ask(_run(), model)  # type: ignore[operator]


def test_a_weak_run_of_the_same_drive_does_not_refuse_what_a_strong_one_shows() -> None:
    """Half the stall torque at 6 V, declared, and a run of 0.3 V: ten times the torque of that run."""
    model = replace(MOTOR, effects={"coulomb-friction": {"coulomb_torque": 0.5 * STALL}})
    check_declared(model, [prepare([_run(0.3)], model).scales])


def test_a_run_without_current_does_not_refuse_friction() -> None:
    """Coasting: what slows the shaft is measured by a torque that nothing drives."""
    coasting = rwn.Recording(name="run", time=TIME, signals={"torque": 0.0 * TIME, "speed": 100.0 - 100.0 * TIME})
    axis = rwn.Model(
        kind="axis", parameters={"inertia": 3e-4, "viscous_friction": 0.0}, uncertainty={"inertia": 0.05},
        effects={"coulomb-friction": {"coulomb_torque": 0.03}},
    )  # fmt: skip
    assert prepare([coasting], axis).scales["torque"] == LEAST
    check_declared(axis, [prepare([coasting], axis).scales])


@pytest.mark.parametrize("value", [-1e9, 1e9])
def test_a_phase_is_not_bounded(value: float) -> None:
    cogging = {"amplitude": 0.01, "periods_per_rev": 7.0, "phase": value}
    model = replace(MOTOR, effects={"cogging-torque": cogging})
    check_declared(model, [prepare([_run()], model).scales])


@pytest.mark.parametrize(("share", "refused"), [(0.001, False), (0.96, False), (1.1, True), (3.0, True)])
def test_a_load_is_a_part_of_the_inertia_that_the_model_states(share: float, refused: bool) -> None:
    """Which every recording has: no other is ten times larger."""
    load = {"stiffness": 50.0, "damping": 0.01, "load_viscous_share": 0.3}
    load["load_inertia"] = share * MOTOR.motor["inertia"]
    model = replace(MOTOR, effects={"shaft-compliance": load})
    with pytest.raises(InputError, match="load_inertia is") if refused else nullcontext():
        check_declared(model, [prepare([_run()], model).scales])


@pytest.mark.parametrize(("current", "refused"), [(1e-6, False), (0.1, False), (1e12, True), (1e-12, True)])
def test_what_makes_a_law_sharp_is_a_number_of_that_drive(current: float, refused: bool) -> None:
    model = replace(MOTOR, effects={"brush-voltage-drop": {"voltage_drop": 0.3, "transition_current": current}})
    scales = prepare([_run()], model).scales
    if refused:
        with pytest.raises(InputError, match="transition_current is 1e"):
            check_declared(model, [scales])
    else:
        check_declared(model, [scales])
