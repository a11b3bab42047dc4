"""A shaft that never turned."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import rwn
from rwn.faults.held_shaft import without_held

DEMO = Path(rwn.__file__).parent / "demo"


@pytest.mark.slow
def test_a_shaft_that_is_held_names_nothing_and_leaves_the_data_sheet() -> None:
    """Current flows and nothing turns: friction or a brake holds it."""
    model = rwn.read_model(DEMO / "model.toml")
    right = rwn.read_recording(DEMO / "train.csv", layout=model.recording)
    rng, n = np.random.default_rng(2), len(right)
    holding = replace(model, effects={"coulomb-friction": {"coulomb_torque": 0.3}})
    voltage = 0.2 * np.asarray(right.signals["voltage"])
    stalled = rwn.simulate(holding, replace(right, signals={"voltage": voltage})).signals["current"]
    signals = {
        "voltage": voltage,
        "current": stalled + 1e-2 * rng.standard_normal(n),
        "speed": 0.5 * rng.standard_normal(n),
    }
    found = rwn.diagnose([replace(right, signals=signals)], model)
    assert found.verdict == "insufficient-excitation"
    assert not found.effects
    assert not found.corrected.effects
    assert "Nothing moved under up to" in found.next_experiment
    assert found.corrected.parameters["inertia"] == pytest.approx(model.parameters["inertia"], rel=0.1)


@pytest.mark.slow
def test_a_voltage_and_a_current_alone_are_explained_too() -> None:
    """Of a shaft that is held and not looked at: no back-EMF shows."""
    model = rwn.read_model(DEMO / "model.toml")
    right = rwn.read_recording(DEMO / "train.csv", layout=model.recording)
    voltage = 0.2 * np.asarray(right.signals["voltage"])
    holding = replace(model, effects={"coulomb-friction": {"coulomb_torque": 0.3}})
    stalled = rwn.simulate(holding, replace(right, signals={"voltage": voltage})).signals["current"]
    noisy = stalled + 1e-2 * np.random.default_rng(2).standard_normal(len(right))
    found = rwn.diagnose([replace(right, signals={"voltage": voltage, "current": noisy})], model)
    assert [e.name for e in found.effects] == ["coulomb-friction"]


def test_a_recording_whose_shaft_is_held_is_left_out_where_others_move() -> None:
    model = rwn.read_model(DEMO / "model.toml")
    moving = rwn.read_recording(DEMO / "train.csv", layout=model.recording)
    rng, n = np.random.default_rng(3), len(moving)
    still = {
        "voltage": moving.signals["voltage"], "current": 0.5 * np.ones(n) + 0.01 * rng.standard_normal(n),
        "speed": 0.5 * rng.standard_normal(n),
    }  # fmt: skip
    held = replace(moving, name="held", signals=still)
    kept, found = without_held([moving, held], model)
    assert kept == [moving]
    assert [f.recording for f in found] == ["held"]
    assert "nothing moves in it, under up to 0.0" in found[0].words
    assert without_held([held], model) == ([held], [])
    assert without_held([held], model, [moving])[0] == []


def test_a_small_input_that_moves_nothing_to_be_seen_is_no_brake() -> None:
    model = rwn.read_model(DEMO / "model.toml")
    moving = rwn.read_recording(DEMO / "train.csv", layout=model.recording)
    rng, n = np.random.default_rng(3), len(moving)
    still = {"voltage": 1e-3 * moving.signals["voltage"], "speed": 0.5 * rng.standard_normal(n)}
    small = replace(moving, name="small", signals=still)
    assert without_held([moving, small], model) == ([moving, small], [])
