"""What is left where the noise of a recorded voltage was taken off."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

import rwn
from rwn.fit.input_errors import of_sensors, with_input_errors
from rwn.fit.nominal import weighted_by_nominal
from rwn.fit.preparation import prepare
from rwn.fit.residuals import statistics
from rwn.model.model import Model
from rwn.recording.inspection import inspected

MOTOR = {
    "resistance": 0.85, "inductance": 7.5e-3, "torque_constant": 1.2, "back_emf_constant": 1.2, "inertia": 0.055,
    "viscous_friction": 0.012,
}  # fmt: skip
MODEL = Model(kind="dc", parameters=MOTOR, uncertainty={"inertia": 0.1, "resistance": 0.05, "viscous_friction": 0.3})
VOLTS = 3.0  # of noise, against 60 of the motion


def _recorded(model: Model) -> rwn.Recording:
    """A large motor under a slow voltage, which was measured with noise."""
    rng, time = np.random.default_rng(5), 2.5e-4 * np.arange(6000)
    voltage = 60.0 * np.sin(9.0 * time) * np.sin(2.0 * time)
    run = rwn.Recording(name="run", time=time, signals={"voltage": voltage})
    shown = rwn.simulate(model, run).signals
    noisy = {s: shown[s] + level * rng.standard_normal(time.size) for s, level in (("current", 0.2), ("speed", 0.1))}
    return replace(run, signals={"voltage": voltage + VOLTS * rng.standard_normal(time.size), **noisy})


def test_errors_of_a_voltage_whose_noise_was_taken_off_are_no_structure() -> None:
    ((recording,), found) = inspected([_recorded(MODEL)])
    assert [f.kind for f in found] == ["input-noise"]
    assert abs(recording.input_noise / VOLTS - 1.0) < 0.05
    problem, nominal = weighted_by_nominal(prepare([recording], MODEL))
    assert statistics(problem, nominal).at_the_floor
    blind, as_white = weighted_by_nominal(prepare([replace(recording, input_noise=0.0)], MODEL))
    assert not statistics(blind, as_white).at_the_floor


def test_physics_that_is_missing_is_seen_beside_them() -> None:
    real = replace(MODEL, effects={"coulomb-friction": {"coulomb_torque": 2.0}})
    ((recording,), _) = inspected([_recorded(real)])
    problem, nominal = weighted_by_nominal(prepare([recording], MODEL))
    assert not statistics(problem, nominal).at_the_floor


def test_the_noise_of_the_sensors_is_kept_and_a_known_voltage_adds_nothing() -> None:
    ((recording,), _) = inspected([_recorded(MODEL)])
    problem, nominal = weighted_by_nominal(prepare([recording], MODEL))
    assert all(n.of_sensor == () and n.reflection for n in problem.noise.values())
    assert all(n.of_sensor is None and not n.reflection for n in of_sensors(problem.noise).values())
    known = prepare([replace(recording, input_noise=0.0)], MODEL)
    assert with_input_errors(known, nominal, known.noise) == known.noise
