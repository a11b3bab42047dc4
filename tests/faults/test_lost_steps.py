"""Rows that were lost where the voltage stepped, with physics missing: when each step came is told by the motion."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from made_up_motor import SMALL as MOTOR
from rwn.measurement.likeliest_law import with_intersample
from rwn.model.model import Model
from rwn.search.search import search

MODEL = Model(kind="dc", parameters=MOTOR, uncertainty={"inertia": 0.1, "viscous_friction": 0.1})


def _run(effects: dict[str, dict[str, float]]) -> rwn.Recording:
    """Noisy speed of a drive whose voltage steps every 40 ms, without the first row of 12 of the steps."""
    rng, time = np.random.default_rng(3), 2e-3 * np.arange(1200)
    voltage = np.repeat(rng.uniform(-4.0, 4.0, 60), 20)
    bare = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    truth = Model(kind="dc", parameters=MOTOR, effects=effects)
    speed = rwn.simulate(truth, bare).signals["speed"] + 0.1 * rng.standard_normal(time.size)
    kept = np.full(time.size, True)
    kept[rng.choice(np.flatnonzero(np.diff(voltage)) + 1, 12, replace=False)] = False
    return replace(bare, time=time[kept], signals={"voltage": voltage[kept], "speed": speed[kept]})


@pytest.mark.slow
def test_the_voltage_of_lost_rows_is_inferred_again_beside_the_physics_that_was_found() -> None:
    """Beside the nominal model it was inferred from what friction did."""
    run = _run({"coulomb-friction": {"coulomb_torque": 1e-2}})
    found = search([run], MODEL, late=(), say=lambda *_: None, effort=0.1)
    assert found.ranking.fits[0].added == ("coulomb-friction",)
    assert found.ranking.left.variance == pytest.approx(1.0, abs=0.1)


def test_lost_rows_are_not_taken_for_a_voltage_that_acts_sooner_in_place_of_missing_physics() -> None:
    run = _run({"brush-voltage-drop": {"voltage_drop": 0.6, "transition_current": 0.1}})
    assert with_intersample([run], MODEL).recording.intersample == "bridged"
