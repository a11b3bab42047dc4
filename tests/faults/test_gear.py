"""A gear ratio that the model does not know is told from physics that takes from the size of the speed."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import rwn
from rwn.faults.scale import wrong_scale
from rwn.search.beneath_faults import beneath_faults

DEMO = Path(rwn.__file__).parent / "demo"


@pytest.fixture(scope="module")
def model() -> rwn.Model:
    return rwn.read_model(DEMO / "model.toml")


@pytest.fixture(scope="module")
def friction(model: rwn.Model) -> rwn.Recording:
    """A run of the demonstration, whose dry friction the model lacks."""
    return rwn.read_recording(DEMO / "train.csv", layout=model.recording)


def geared(recording: rwn.Recording, ratio: float) -> rwn.Recording:
    """The recording of a speed sensor behind a gear."""
    return replace(recording, signals={**recording.signals, "speed": ratio * recording.signals["speed"]})


def silent(what: str, done: float) -> None:
    """Progress that nobody asked for."""


@pytest.mark.parametrize("ratio", [0.4, 1.0 / 3.5, -0.3, 4.0])
def test_gear_ratio(model: rwn.Model, friction: rwn.Recording, ratio: float) -> None:
    found = wrong_scale([geared(friction, ratio)], model)
    assert found is not None
    assert (found.name, found.also) == ("wrong-gear-ratio", ())
    assert found.factor == pytest.approx(ratio, rel=0.15)  # friction slows the motor too


@pytest.mark.parametrize(("ratio", "believed"), [(1.0 / 300.0, True), (3e5, False), (1e-5, False)])
def test_a_ratio_that_no_gear_has_is_said_to_be_a_wrong_scale(
    ratio: float, believed: bool, model: rwn.Model, friction: rwn.Recording
) -> None:
    found = wrong_scale([geared(friction, ratio)], model)
    assert found is not None
    assert found.factor == pytest.approx(ratio, rel=0.15)
    assert ("which no gear does: its unit or scale is wrong" in found.meaning) != believed


@pytest.mark.slow
def test_the_ratio_of_a_gear_is_fitted_with_the_physics_beneath_it(model: rwn.Model, friction: rwn.Recording) -> None:
    wrong = geared(friction, 1.0 / 3.5)
    first = wrong_scale([wrong], model)
    faults, ranking = beneath_faults([wrong], model, say=silent)
    assert first is not None
    assert [f.name for f in faults] == ["wrong-gear-ratio"]
    assert abs(3.5 * faults[0].factor - 1.0) <= abs(3.5 * first.factor - 1.0)
    assert faults[0].factor == pytest.approx(1.0 / 3.5, rel=0.05)
    interval = faults[0].found().parameters["factor"].interval
    assert interval is not None
    assert interval[0] < 1.0 / 3.5 < interval[1]
    assert ranking.fits[0].added == ("coulomb-friction",)


@pytest.mark.parametrize(("share", "ratio"), [(0.6, 1.0), (0.8, 1.0), (0.3, 0.4), (0.3, 4.0)])
def test_what_friction_takes_from_small_steps_is_no_gear(model: rwn.Model, share: float, ratio: float) -> None:
    """Between 2.8 and 3.2 V a level of friction makes much of the speed's size, and nothing of what it changes by."""
    time = np.arange(0.0, 2.0, 1e-3)
    voltage = np.where((time // 0.1) % 2 > 0, 3.2, 2.8)
    stall = model.parameters["torque_constant"] * 2.8 / model.parameters["resistance"]
    rubbing = replace(model, effects={"coulomb-friction": {"coulomb_torque": share * stall}})
    unseen = rwn.Recording(name="steps", time=time, signals={"voltage": voltage, "speed": np.zeros(time.size)})
    speed = ratio * rwn.simulate(rubbing, unseen).signals["speed"]
    found = wrong_scale([replace(unseen, signals={"voltage": voltage, "speed": speed})], model)
    assert (found.name if found else None) == (None if ratio == 1.0 else "wrong-gear-ratio")
    if found:
        assert found.factor == pytest.approx(ratio, rel=0.25)


def test_a_level_that_no_scale_makes_is_no_gear(model: rwn.Model) -> None:
    """A bridge that passes small commands four times as steeply, beyond a dead zone: no gear gives both."""
    time = np.arange(0.0, 10.0, 0.02)
    voltage = np.where(time < 5.0, 0.363, 0.4375)
    unseen = rwn.Recording(name="step", time=time, signals={"voltage": voltage, "speed": np.zeros(time.size)})
    passed = replace(unseen, signals={"voltage": 4.0 * (voltage - 0.25), "speed": np.zeros(time.size)})
    speed = rwn.simulate(model, passed).signals["speed"]
    assert wrong_scale([replace(unseen, signals={"voltage": voltage, "speed": speed})], model) is None


@pytest.mark.slow
def test_a_gear_that_stood_in_for_a_drag_is_none(model: rwn.Model) -> None:
    """A drag that takes most of the speed looks like a gear until it is known itself."""
    time = np.arange(0.0, 3.0, 1e-3)
    voltage = 4.0 * np.sin(2.0 * np.pi * 0.7 * time) + 3.0 * np.sin(2.0 * np.pi * 1.9 * time)
    dragged = replace(model, effects={"quadratic-drag": {"drag_coefficient": 2e-5}})
    unseen = rwn.Recording(name="swings", time=time, signals={"voltage": voltage, "speed": np.zeros(time.size)})
    noise = 0.3 * np.random.default_rng(1).standard_normal(time.size)
    speed = rwn.simulate(dragged, unseen).signals["speed"] + noise
    recording = replace(unseen, signals={"voltage": voltage, "speed": speed})
    suspected = wrong_scale([recording], model)
    assert suspected is not None
    assert suspected.name == "wrong-gear-ratio"
    faults, ranking = beneath_faults([recording], model, say=silent)
    assert faults == []
    assert set(ranking.fits[0].added) <= {"quadratic-drag", "power-law-drag"}
