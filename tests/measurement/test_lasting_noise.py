"""Noise of a speed that lasts is told from motion by the winding."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.signal import cont2discrete, lfilter

import rwn
from made_up_motor import MOTOR
from rwn.fit.fit import fit_nominal
from rwn.fit.preparation import prepare
from rwn.fit.residual_noise import with_noise_of
from rwn.fit.residuals import statistics
from rwn.measurement.filter_colour import SensorFilter
from rwn.measurement.known_filters import filtered, known_filters
from rwn.measurement.lasting_noise import lasting_noise
from rwn.model.model import Model

Array = NDArray[np.float64]

STEP, SAMPLES = 1e-3, 6000
MODEL = Model(kind="dc", parameters=MOTOR, uncertainty={"inertia": 0.1})
RNG = np.random.default_rng(4)
LASTING = lfilter([0.06], [1.0, -0.9], RNG.standard_normal(SAMPLES))  # beside white noise: no first order


def _driven(torque: Array) -> dict[str, Array]:
    """Voltage, current and speed (n,) of the motor under one more torque (n,), both held over a step."""
    r, inductance, kt, ke, inertia, b = MOTOR.values()
    rates = np.array([[-r / inductance, -ke / inductance], [kt / inertia, -b / inertia]])
    linear = (rates, np.diag([1.0 / inductance, 1.0 / inertia]), np.eye(2), np.zeros((2, 2)))
    a, given, *_ = cont2discrete(linear, STEP)
    voltage = np.repeat(np.random.default_rng(1).uniform(-6.0, 6.0, SAMPLES // 40), 40)
    rows = np.zeros((SAMPLES, 2))
    for k in range(SAMPLES - 1):
        rows[k + 1] = a @ rows[k] + given @ (voltage[k], torque[k])
    rows += np.array([0.01, 0.02]) * np.random.default_rng(2).standard_normal((SAMPLES, 2))
    return {"voltage": voltage, "current": rows[:, 0], "speed": rows[:, 1]}


def _found(*, torque: Array | float = 0.0, sensor: Array | float = 0.0, without: str = "") -> list[SensorFilter]:
    signals = _driven(np.broadcast_to(torque, SAMPLES))
    signals["speed"] = signals["speed"] + sensor
    kept = {name: values for name, values in signals.items() if name != without}
    problem = prepare([rwn.Recording(name="run", time=STEP * np.arange(SAMPLES), signals=kept)], MODEL)
    found = lasting_noise(problem, fit_nominal(problem))
    if found:
        on = with_noise_of(filtered(problem, found), fit_nominal(problem))
        assert known_filters(on) == tuple(found)
        assert statistics(on, fit_nominal(on)).at_the_floor
    assert not statistics(problem, fit_nominal(problem)).at_the_floor
    return found


def test_what_the_winding_knows_nothing_of_is_noise_of_the_sensor() -> None:
    (found,) = _found(sensor=LASTING)
    assert (found.signal, found.of_noise, len(found.reflection)) == ("speed", True, 8)


@pytest.mark.parametrize("size", [0.05, 0.5])
def test_a_shaft_that_is_driven_to_and_fro_is_no_noise(size: float) -> None:
    """Its speed errs as the sensor's does, and induces what the winding shows."""
    assert not _found(torque=size * LASTING)


def test_what_grows_with_the_speed_is_no_noise() -> None:
    speed = _driven(np.zeros(SAMPLES))["speed"]
    assert not _found(sensor=LASTING * (np.abs(speed) / np.mean(np.abs(speed))) ** 2)


def test_without_a_current_nothing_tells_them_apart() -> None:
    assert not _found(sensor=LASTING, without="current")
