"""Brushes, winding and flux."""

from __future__ import annotations

import numpy as np

from rwn.studies.trials.effects.definition import Effect, Situation, log_uniform, renamed, times
from rwn.studies.trials.effects.torque import draw_periods
from rwn.studies.trials.plant import Values

Rng = np.random.Generator

COPPER = 0.00393  # relative rise of the resistance per kelvin


def _draw_brush(rng: Rng, s: Situation) -> Values:
    return {
        "voltage_drop": s.voltage * log_uniform(rng, 0.01, 0.1),
        "transition_current": s.current_peak * log_uniform(rng, 0.01, 0.05),
    }


def _draw_heating(rng: Rng, s: Situation) -> Values:
    heat = s.motor.resistance * s.current**2
    settled = log_uniform(rng, 0.1, 0.6) / COPPER  # K, after a long time at this current
    resistance = settled / heat
    time_constant = s.duration * log_uniform(rng, 0.3, 3.0)
    return {
        "thermal_resistance": resistance,
        "heat_capacity": time_constant / resistance,
        "temperature_coefficient": COPPER,
    }


def _scale_heating(values: Values, factor: float) -> Values:
    return values | {
        "thermal_resistance": values["thermal_resistance"] * factor,
        "heat_capacity": values["heat_capacity"] / factor,
    }


def _draw_saturation(rng: Rng, s: Situation) -> Values:
    return {"saturation_current": s.current_peak * log_uniform(rng, 1.0, 4.0)}


def _draw_ripple(rng: Rng, _: Situation) -> Values:
    return {"amplitude": log_uniform(rng, 0.02, 0.15), "harmonic": draw_periods(rng)}


EFFECTS = (
    Effect(
        name="brush-voltage-drop",
        equation="electrical",
        units={"voltage_drop": "V", "transition_current": "A"},
        draw=_draw_brush,
        build=renamed(voltage_drop="brush_drop", transition_current="brush_current"),
        scale=times("voltage_drop"),
        rivals=("coulomb-friction", "actuator-deadzone", "load-dependent-friction"),
    ),
    Effect(
        name="resistance-heating",
        equation="electrical",
        units={"thermal_resistance": "K/W", "heat_capacity": "J/K", "temperature_coefficient": "1/K"},
        draw=_draw_heating,
        build=renamed(
            thermal_resistance="thermal_resistance",
            heat_capacity="heat_capacity",
            temperature_coefficient="temperature_coefficient",
        ),
        scale=_scale_heating,
        fixed=frozenset({"temperature_coefficient"}),
        rivals=("magnetic-saturation", "torque-constant-drift", "viscous-friction-drift"),
    ),
    Effect(
        name="magnetic-saturation",
        equation="electrical",
        units={"saturation_current": "A"},
        draw=_draw_saturation,
        build=renamed(saturation_current="saturation_current"),
        scale=times("saturation_current", power=-0.5),
        rivals=("load-dependent-friction", "resistance-heating", "voltage-saturation", "quadratic-drag"),
    ),
    Effect(
        name="torque-ripple",
        equation="electrical",
        units={"amplitude": "1", "harmonic": "1"},
        draw=_draw_ripple,
        build=renamed(amplitude="ripple_amplitude", harmonic="ripple_harmonic"),
        scale=times("amplitude"),
        limits={"amplitude": (0.0, 0.7)},
        linear=frozenset({"amplitude"}),
        fixed=frozenset({"harmonic"}),
        rivals=("cogging-torque", "unbalance"),
        slow=True,
    ),
)
