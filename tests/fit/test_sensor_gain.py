"""Sensors whose scale is a little off, by what their data sheets allow: `sensor-gain` with its doubt."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from rwn.errors import InputError

MOTOR = {
    "resistance": 1.1, "inductance": 4.5e-4, "torque_constant": 0.037, "back_emf_constant": 0.037, "inertia": 2.9e-5,
    "viscous_friction": 6e-6, "coulomb_friction": 4.5e-3,
}  # fmt: skip
SURE = {
    "resistance": 0.07, "torque_constant": 0.04, "back_emf_constant": 0.04, "inertia": 0.08, "coulomb_friction": 0.2,
}  # fmt: skip
GAINS = ("speed_gain", "current_gain")


def _model(doubt: float | None) -> rwn.Model:
    model = rwn.Model(kind="dc", parameters=MOTOR, uncertainty=SURE)
    if doubt is None:
        return model
    doubts = {f"sensor-gain.{name}": doubt for name in GAINS}
    return replace(model, effects={"sensor-gain": dict.fromkeys(GAINS, 1.0)}, uncertainty={**SURE, **doubts})


def _recording(speed_gain: float) -> rwn.Recording:
    time, rng = np.arange(3000) * 1e-3, np.random.default_rng(5)
    voltage = 8.0 * np.sin(7.0 * time) * np.sign(np.sin(23.0 * time))
    bare = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    shown = dict(rwn.simulate(_model(None), bare).signals)
    shown["speed"] = speed_gain * shown["speed"]
    noisy = {s: shown[s] + level * rng.standard_normal(time.size) for s, level in (("current", 0.03), ("speed", 0.3))}
    return replace(bare, signals={"voltage": voltage, **noisy})


def test_intervals_of_the_motor_count_with_what_a_scale_may_be_off() -> None:
    """A motor's parameters stand for a scale nearly as well as it does itself: its doubt is theirs."""
    run = _recording(1.01)
    declared, exact = (rwn.identify(run, _model(doubt)).parameters["back_emf_constant"] for doubt in (0.01, None))
    assert declared.interval is not None
    assert exact.interval is not None
    assert declared.interval[0] < MOTOR["back_emf_constant"] < declared.interval[1]
    assert exact.interval[1] < MOTOR["back_emf_constant"]


def test_a_scale_is_told_where_the_motor_is_known() -> None:
    known = _model(0.01)
    doubts = {name: value for name, value in known.uncertainty.items() if name.startswith("sensor-gain")}
    found = rwn.identify(_recording(1.01), replace(known, uncertainty=doubts))
    assert found.parameters["sensor-gain.speed_gain"].value == pytest.approx(1.01, abs=1e-3)
    assert found.parameters["sensor-gain.current_gain"].value == pytest.approx(1.0, abs=2e-3)


def test_a_scale_that_is_declared_exact_is_left_as_it_is() -> None:
    found = rwn.identify(_recording(1.0), replace(_model(0.01), uncertainty=SURE))
    assert not any(name.startswith("sensor-gain") for name in found.parameters)


def test_a_simulation_shows_what_such_a_sensor_would() -> None:
    run, exact = _recording(1.0), _model(0.01)
    off = replace(exact, effects={"sensor-gain": {"speed_gain": 1.02, "current_gain": 0.97}})
    shown, true = rwn.simulate(off, run).signals, rwn.simulate(exact, run).signals
    assert shown["speed"] == pytest.approx(1.02 * true["speed"])
    assert shown["current"] == pytest.approx(0.97 * true["current"])


def test_a_scale_is_never_named_where_it_is_not_declared() -> None:
    found = rwn.diagnose(_recording(1.02), _model(None), jobs=1, effort=0.1)
    assert all(effect.name != "sensor-gain" for effect in found.effects)


def test_a_scale_that_no_sensor_has_is_refused() -> None:
    with pytest.raises(InputError, match="speed_gain"):
        replace(_model(0.01), effects={"sensor-gain": {"speed_gain": 0.0, "current_gain": 1.0}})
