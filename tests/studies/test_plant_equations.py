"""The plant's effects against scipy's integrator on the equations that answers state."""
# ruff: noqa: ARG005  (hooks all have the same arguments, most use few)

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

import plant_reference as judge
from plant_machine import BOTH_WAYS, FORWARD, KT, NOMINAL, RATE, J, R, built
from plant_reference import Machine, two_masses
from rwn.studies.trials.effects import EFFECTS
from rwn.studies.trials.motors import plant_of
from rwn.studies.trials.plant import simulate


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
