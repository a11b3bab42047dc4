"""The independent plant against scipy, its sensors' definitions, and another maker's recordings."""
# ruff: noqa: ARG005  (hooks all have the same arguments, most use few)

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import plant_reference as judge
from plant_reference import Machine, two_masses
from rwn.studies.trials.dossier import read_columns
from rwn.studies.trials.effects import EFFECTS
from rwn.studies.trials.motors import MOTORS, plant_of
from rwn.studies.trials.plant import Trace, simulate

RATE = 1000.0
MOTOR = next(motor for motor in MOTORS if motor.name == "M06-40W-24V")
NOMINAL = MOTOR.nominal(dry=False)
J, B, KT, R = (
    NOMINAL["inertia"],
    NOMINAL["viscous_friction"],
    NOMINAL["torque_constant"],
    NOMINAL["resistance"],
)
TIME = np.arange(100) / RATE
BOTH_WAYS = np.round(
    5.0 * np.sin(2.0 * np.pi * 9.0 * TIME) + 2.0 * np.sin(2.0 * np.pi * 41.0 * TIME + 0.4), 5
)
FORWARD = np.round(6.0 + 2.0 * np.sin(2.0 * np.pi * 30.0 * TIME), 5)  # never turns back


def dry(level: Callable[[float, float, float], float]) -> Machine:
    """Friction of this level (current, speed, angle) on a rotor that leaves rest and turns forward."""
    return Machine(
        braking=lambda t, i, w, th: level(i, w, th) if w > 1e-9 else min(level(i, 0.0, th), KT * i)
    )


# effect: values as in an answer, command, the machine that the answer's equation describes
EQUATIONS = {
    "coulomb-friction": ({"coulomb_torque": 0.004}, FORWARD, dry(lambda i, w, th: 0.004)),
    "stribeck-friction": (
        {"coulomb_torque": 0.004, "static_torque": 0.006, "stribeck_speed": 20.0},
        FORWARD,
        dry(lambda i, w, th: 0.004 + 0.002 * np.exp(-((w / 20.0) ** 2))),
    ),
    "asymmetric-friction": (
        {"coulomb_torque_plus": 0.005, "coulomb_torque_minus": 0.001},
        FORWARD,
        dry(lambda i, w, th: 0.005),
    ),
    "load-dependent-friction": (
        {"friction_ratio": 0.1},
        FORWARD,
        dry(lambda i, w, th: 0.1 * abs(KT * i)),
    ),
    "presliding-hysteresis": (
        {"bristle_stiffness": 0.1, "bristle_damping": 3e-4},
        BOTH_WAYS,
        Machine(
            extras=1,
            extra=lambda t, i, w, th, z: (w - 0.1 * abs(w) * z / 0.005,),
            coupling=lambda t, i, w, th, z: 0.1 * z + 3e-4 * (w - 0.1 * abs(w) * z / 0.005),
        ),
    ),
    "position-dependent-friction": (
        {"coulomb_torque": 0.004, "variation": 0.6, "phase": 0.7},
        FORWARD,
        dry(lambda i, w, th: 0.004 * (1.0 + 0.6 * np.cos(th + 0.7))),
    ),
    "quadratic-drag": (
        {"drag_coefficient": 2e-6},
        BOTH_WAYS,
        Machine(braking=lambda t, i, w, th: 2e-6 * w * abs(w)),
    ),
    "cogging-torque": (
        {"amplitude": 0.01, "periods_per_rev": 7.0, "phase": -1.0},
        BOTH_WAYS,
        Machine(braking=lambda t, i, w, th: 0.01 * np.sin(7.0 * th - 1.0)),
    ),
    "unbalance": (
        {"amplitude": 0.01, "phase": 2.0},
        BOTH_WAYS,
        Machine(braking=lambda t, i, w, th: 0.01 * np.sin(th + 2.0)),
    ),
    "load-disturbance": (
        {"torque": 0.01, "t_start": 0.0403, "t_end": 0.0807},
        BOTH_WAYS,
        Machine(braking=lambda t, i, w, th: 0.01 * (0.0403 < t < 0.0807)),
    ),
    "inertia-variation": (
        {"amplitude": 0.3 * J},
        BOTH_WAYS,
        Machine(inertia=lambda th: (0.3 * J * np.cos(2 * th), -0.6 * J * np.sin(2 * th))),
    ),
    "backlash": (
        {"gap": 0.05, "load_inertia": 0.5 * J, "contact_rate": 900.0, "contact_damping": 0.4,
         "load_viscous_share": 0.3},
        BOTH_WAYS,
        two_masses(NOMINAL, 0.5 * J, 0.25 * J * 900.0**2, 2.0 * 0.4 * 0.25 * J * 900.0, 0.05),
    ),
    "shaft-compliance": (
        {"stiffness": 0.5, "damping": 2e-4, "load_inertia": 0.4 * J, "load_viscous_share": 0.3},
        BOTH_WAYS,
        two_masses(NOMINAL, 0.4 * J, 0.5, 2e-4),
    ),
    "brush-voltage-drop": (
        {"voltage_drop": 0.8, "transition_current": 0.1},
        BOTH_WAYS,
        Machine(drop=lambda t, i, w, th: 0.8 * np.tanh(i / 0.1)),
    ),
    "resistance-heating": (
        {"thermal_resistance": 20.0, "heat_capacity": 0.01, "temperature_coefficient": 0.00393},
        BOTH_WAYS,
        Machine(
            warmth=lambda t, i, w, th, rise: 1.0 + 0.00393 * rise,
            extras=1,
            extra=lambda t, i, w, th, rise: ((R * (1 + 0.00393 * rise) * i * i - rise / 20.0) / 0.01,),
        ),
    ),
    "magnetic-saturation": (
        {"saturation_current": 4.0},
        BOTH_WAYS,
        Machine(
            flux=lambda t, i, w, th: 1.0 / (1.0 + (i / 4.0) ** 2),
            inductance=lambda t, i, w, th: 1.0 / (1.0 + (i / 4.0) ** 2),
        ),
    ),
    "torque-ripple": (
        {"amplitude": 0.2, "harmonic": 5.0},
        BOTH_WAYS,
        Machine(flux=lambda t, i, w, th: 1.0 + 0.2 * np.cos(5.0 * th)),
    ),
    "actuator-deadzone": (
        {"deadzone": 0.9},
        BOTH_WAYS,
        Machine(driver=lambda v: np.sign(v) * max(abs(v) - 0.9, 0.0)),
    ),
    "voltage-saturation": (
        {"limit": 3.5},
        BOTH_WAYS,
        Machine(driver=lambda v: min(max(v, -3.5), 3.5)),
    ),
    "input-delay": ({"delay": 2.35e-3}, BOTH_WAYS, Machine(delay=2.35e-3)),
    "periodic-external-torque": (
        {"amplitude": 0.01, "frequency": 31.0, "phase": 0.3},
        BOTH_WAYS,
        Machine(braking=lambda t, i, w, th: 0.01 * np.sin(2 * np.pi * 31.0 * t + 0.3)),
    ),
    "cubic-drag": ({"coefficient": 1e-8}, BOTH_WAYS, Machine(braking=lambda t, i, w, th: 1e-8 * w**3)),
    "square-root-drag": (
        {"coefficient": 5e-4},
        FORWARD,
        Machine(braking=lambda t, i, w, th: 5e-4 * np.sqrt(abs(w)) * np.sign(w)),
    ),
    "torque-constant-drift": ({"rate": 2.0}, BOTH_WAYS, Machine(flux=lambda t, i, w, th: 1.0 + 2.0 * t)),
    "viscous-friction-drift": (
        {"excess": 2e-4, "time_constant": 0.05},
        BOTH_WAYS,
        Machine(braking=lambda t, i, w, th: 2e-4 * np.exp(-t / 0.05) * w),
    ),
    "reluctance-torque": (
        {"coefficient": 0.002},
        BOTH_WAYS,
        Machine(braking=lambda t, i, w, th: 0.002 * i * i),
    ),
    "amplifier-compression": (
        {"coefficient": 0.004},
        BOTH_WAYS,
        Machine(driver=lambda v: v * (1.0 - 0.004 * v * v)),
    ),
}
SENSED = {"speed-sensor-lag", "sensor-rectification", "sensor-bias", "sensor-quantization", "slew-rate-limit"}
# Kinks that one of the two integrators meets without knowing where.
JUMPS = {
    "load-disturbance",
    "backlash",
    "square-root-drag",
    "coulomb-friction",
    "stribeck-friction",
    "asymmetric-friction",
    "load-dependent-friction",
    "position-dependent-friction",
}


def built(name: str, values: dict[str, float]) -> dict[str, float]:
    dry = name == "presliding-hysteresis"
    nominal = NOMINAL | ({"coulomb_friction": 0.005} if dry else {})
    return plant_of(nominal) | EFFECTS[name].build(values, nominal)


def test_every_effect_is_judged() -> None:
    assert set(EQUATIONS) | SENSED == set(EFFECTS)


@pytest.mark.parametrize("name", EQUATIONS)
def test_effect_does_what_its_equation_says(name: str) -> None:
    values, voltage, machine = EQUATIONS[name]
    judged = judge.run(NOMINAL, machine, voltage, RATE)
    found = simulate(built(name, values), voltage, rate=RATE)
    plain = simulate(plant_of(NOMINAL), voltage, rate=RATE)
    limit = 2e-4 if name in JUMPS else 5e-6
    scale = float(np.max(np.abs(judged[:, 1])))
    off = float(np.max(np.abs(found.speed - judged[:, 1])))
    effect = float(np.max(np.abs(found.speed - plain.speed)))
    assert off < limit * scale
    assert effect > 100.0 * off, "the effect must be far larger than the tolerance to be tested at all"
    np.testing.assert_allclose(found.current, judged[:, 0], atol=20 * limit * np.max(np.abs(judged[:, 0])))


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
