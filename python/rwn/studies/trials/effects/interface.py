"""The driver before the motor and the sensors behind it."""

from __future__ import annotations

import numpy as np

from rwn.studies.trials.effects.definition import Effect, Situation, log_uniform, renamed, times
from rwn.studies.trials.plant import Values

Rng = np.random.Generator


def _draw_deadzone(rng: Rng, s: Situation) -> Values:
    return {"deadzone": s.voltage * log_uniform(rng, 0.01, 0.1)}


def _draw_limit(rng: Rng, s: Situation) -> Values:
    return {"limit": s.voltage * rng.uniform(0.6, 0.95)}


def _draw_delay(rng: Rng, s: Situation) -> Values:
    return {"delay": log_uniform(rng, 0.5, 4.0) / s.rate}


def _draw_lag(rng: Rng, s: Situation) -> Values:
    return {"time_constant": log_uniform(rng, 0.7, 5.0) / s.rate}


def _draw_bias(rng: Rng, s: Situation) -> Values:
    sign = 1.0 if rng.random() < 0.5 else -1.0
    return {"speed_offset": sign * s.speed * log_uniform(rng, 0.01, 0.1)}


def _draw_quantization(rng: Rng, s: Situation) -> Values:
    return {"resolution": s.speed * log_uniform(rng, 0.02, 0.1)}


def _analogue(s: Situation) -> bool:
    return not s.encoder


EFFECTS = (
    Effect(
        name="actuator-deadzone",
        equation="actuator",
        units={"deadzone": "V"},
        draw=_draw_deadzone,
        build=renamed(deadzone="deadzone"),
        scale=times("deadzone"),
        rivals=("coulomb-friction", "brush-voltage-drop", "stribeck-friction"),
    ),
    Effect(
        name="voltage-saturation",
        equation="actuator",
        units={"limit": "V"},
        draw=_draw_limit,
        build=renamed(limit="voltage_limit"),
        scale=times("limit", power=-0.25),
        rivals=("amplifier-compression", "quadratic-drag", "magnetic-saturation"),
    ),
    Effect(
        name="input-delay",
        equation="actuator",
        units={"delay": "s"},
        draw=_draw_delay,
        build=renamed(delay="delay"),
        scale=times("delay"),
        rivals=("speed-sensor-lag", "shaft-compliance", "slew-rate-limit"),
    ),
    Effect(
        name="speed-sensor-lag",
        equation="sensor",
        units={"time_constant": "s"},
        draw=_draw_lag,
        build=renamed(time_constant="speed_lag"),
        scale=times("time_constant"),
        suits=_analogue,
        rivals=("input-delay", "shaft-compliance"),
    ),
    Effect(
        name="sensor-rectification",
        equation="sensor",
        units={},
        draw=lambda _rng, _s: {},
        build=lambda _values, _nominal: {"rectification": 1.0},
        scale=None,
        suits=_analogue,
    ),
    Effect(
        name="sensor-bias",
        equation="sensor",
        units={"speed_offset": "rad/s"},
        draw=_draw_bias,
        build=renamed(speed_offset="speed_offset"),
        scale=times("speed_offset"),
        suits=_analogue,
        linear=frozenset({"speed_offset"}),
        rivals=("asymmetric-friction", "load-disturbance"),
    ),
    Effect(
        name="sensor-quantization",
        equation="sensor",
        units={"resolution": "rad/s"},
        draw=_draw_quantization,
        build=renamed(resolution="speed_quantum"),
        scale=times("resolution"),
        suits=_analogue,
    ),
)
