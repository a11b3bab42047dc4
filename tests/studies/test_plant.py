"""The independent plant: its motor and sensors by scipy and by definition, and another maker's recordings."""
# ruff: noqa: ARG005  (hooks all have the same arguments, most use few)

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import plant_reference as judge
from plant_machine import BOTH_WAYS, FORWARD, NOMINAL, RATE, TIME, built
from plant_reference import Machine
from rwn.studies.trials.motors import plant_of
from rwn.studies.trials.plant import Trace, simulate
from rwn.studies.trials.trial_files import read_columns


@pytest.fixture(scope="module")
def plain() -> Trace:
    return simulate(plant_of(NOMINAL), BOTH_WAYS, rate=RATE)


def test_nominal_motor_matches_an_independent_integrator(plain: Trace) -> None:
    judged = judge.run(NOMINAL, Machine(), BOTH_WAYS, RATE)
    np.testing.assert_allclose(plain.speed, judged[:, 1], atol=1e-6 * np.max(np.abs(judged[:, 1])))
    np.testing.assert_allclose(plain.current, judged[:, 0], atol=1e-6 * np.max(np.abs(judged[:, 0])))
    np.testing.assert_allclose(plain.position, judged[:, 2], atol=1e-6 * np.max(np.abs(judged[:, 2])))


def test_rectified_speed_is_the_magnitude(plain: Trace) -> None:
    seen = simulate(built("sensor-rectification", {}), BOTH_WAYS, rate=RATE)
    np.testing.assert_array_equal(seen.sensed_speed, np.abs(plain.speed))
    np.testing.assert_array_equal(seen.speed, plain.speed)


def test_biased_speed_is_shifted(plain: Trace) -> None:
    seen = simulate(built("sensor-bias", {"speed_offset": -1.5}), BOTH_WAYS, rate=RATE)
    np.testing.assert_array_equal(seen.sensed_speed, plain.speed - 1.5)


def test_quantized_speed_comes_in_steps(plain: Trace) -> None:
    seen = simulate(built("sensor-quantization", {"resolution": 0.7}), BOTH_WAYS, rate=RATE).sensed_speed
    np.testing.assert_allclose(seen / 0.7, np.round(seen / 0.7), atol=1e-9)
    assert np.max(np.abs(seen - plain.speed)) <= 0.35 + 1e-9


def test_lagging_sensor_is_a_first_order_filter(plain: Trace) -> None:
    tau = 4e-3
    seen = simulate(built("speed-sensor-lag", {"time_constant": tau}), BOTH_WAYS, rate=RATE)
    machine = Machine(extras=1, extra=lambda t, i, w, th, y: ((w - y) / tau,))
    judged = judge.run(NOMINAL, machine, BOTH_WAYS, RATE)[:, 3]
    np.testing.assert_allclose(seen.sensed_speed, judged, atol=1e-6 * np.max(np.abs(judged)))
    np.testing.assert_allclose(seen.speed, plain.speed, atol=1e-9)


def test_slow_driver_ramps_to_the_command() -> None:
    """A ramp is many small steps: the same commands, interpolated on a grid thirty times finer."""
    slew, finer = 700.0, 30
    command = np.where(TIME < 0.05, 3.0, -2.0)
    seen = simulate(built("slew-rate-limit", {"slew_rate": slew}), command, rate=RATE)
    fine_time = (np.arange(TIME.size * finer) + 0.5) / (RATE * finer)
    ramped = np.where(
        fine_time < 0.05,
        np.minimum(slew * fine_time, 3.0),
        np.maximum(3.0 - slew * (fine_time - 0.05), -2.0),
    )
    stepped = simulate(plant_of(NOMINAL), ramped, rate=RATE * finer)
    np.testing.assert_allclose(seen.speed, stepped.speed[::finer], atol=1e-3)


def test_slow_driver_that_chases_every_command_comes_to_an_end() -> None:
    """Rounding used to leave an ulp of the ramp, approached for ever, once per many thousand commands."""
    command = 10.0 * np.random.default_rng(0).standard_normal(20_000)
    seen = simulate(built("slew-rate-limit", {"slew_rate": 8930.0}), command, rate=2000.0)
    assert np.isfinite(seen.speed).all()


def test_unknown_parameter_is_refused() -> None:
    with pytest.raises(ValueError, match="frictoin"):
        simulate({"frictoin": 1.0}, FORWARD, rate=RATE)


def test_parameter_that_is_not_a_number_is_refused() -> None:
    with pytest.raises(ValueError, match="resistance"):
        simulate({"resistance": np.nan}, FORWARD, rate=RATE)


# The other maker's names of plant parameters.
CASE_NAMES = {
    "R": "resistance",
    "L": "inductance",
    "Kt": "torque_constant",
    "Ke": "back_emf_constant",
    "J": "inertia",
    "B": "viscous_friction",
    "TCP": "coulomb_plus",
    "TCM": "coulomb_minus",
    "DTS": "stribeck_excess",
    "WS": "stribeck_speed",
    "KQ": "quadratic_drag",
    "COGA": "cogging_amplitude",
    "COGN": "cogging_periods",
    "COGP": "cogging_phase",
    "TD": "load_torque",
    "TD0": "load_start",
    "TD1": "load_end",
    "PXA": "periodic_amplitude",
    "PXF": "periodic_frequency",
    "PXP": "periodic_phase",
    "JL": "load_inertia",
    "BL": "load_viscous",
    "KSH": "stiffness",
    "CSH": "damping",
    "VB": "brush_drop",
    "IB": "brush_current",
    "RTH": "thermal_resistance",
    "CTH": "heat_capacity",
    "ALPHA": "temperature_coefficient",
    "DELAY": "delay",
    "VMAX": "voltage_limit",
    "RECT": "rectification",
}


@pytest.mark.parametrize("number", range(1, 15))
def test_plant_reproduces_the_example_cases(shared: Path, number: int) -> None:
    """To within 1 % of the noise, on both held-out recordings, with the parameters of the answer."""
    folder = shared / "cases" / f"case_{number:02d}"
    answer = json.loads((folder / "answer.json").read_text())
    given = {name: value for name, value in answer["plant"].items() if name != "TWO"}
    plant = {CASE_NAMES[name]: value for name, value in given.items()}
    plant["viscous_friction"] += plant.get("load_viscous", 0.0)  # theirs is the motor side's
    for clean in sorted(folder.glob("heldout_*_clean.csv")):
        columns = read_columns(clean)
        found = simulate(plant, columns["voltage"], rate=answer["sample_rate_Hz"])
        off = np.sqrt(np.mean((found.sensed_speed - columns["speed"]) ** 2))
        assert off < 0.01 * answer["noise"]["speed_rms"]
        if "current" in columns:
            off = np.sqrt(np.mean((found.sensed_current - columns["current"]) ** 2))
            assert off < 0.01 * answer["noise"]["current_rms"]
