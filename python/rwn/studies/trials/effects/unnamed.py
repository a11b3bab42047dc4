"""Physics that has no name in the vocabulary: the right answer is `unexplained`."""

from __future__ import annotations

import numpy as np

from rwn.studies.trials.effects.definition import Effect, Situation, log_uniform, phase, renamed, times
from rwn.studies.trials.plant import Values

Rng = np.random.Generator


def _draw_periodic(rng: Rng, s: Situation) -> Values:
    return {
        "amplitude": s.torque * log_uniform(rng, 0.05, 0.4),
        "frequency": log_uniform(rng, 5.0, 60.0) / s.duration,
        "phase": phase(rng),
    }


def _draw_cubic(rng: Rng, s: Situation) -> Values:
    return {"coefficient": s.torque / s.speed**3 * log_uniform(rng, 0.02, 0.3)}


def _draw_root(rng: Rng, s: Situation) -> Values:
    return {"coefficient": s.torque / s.speed**0.5 * log_uniform(rng, 0.05, 0.4)}


def _draw_flux(rng: Rng, s: Situation) -> Values:
    sign = 1.0 if rng.random() < 0.5 else -1.0
    return {"rate": sign * log_uniform(rng, 0.03, 0.2) / s.duration}


def _draw_warming(rng: Rng, s: Situation) -> Values:
    return {
        "excess": s.torque / s.speed * log_uniform(rng, 0.05, 0.5),
        "time_constant": s.duration * rng.uniform(0.15, 0.6),
    }


def _draw_reluctance(rng: Rng, s: Situation) -> Values:
    return {"coefficient": s.torque / s.current**2 * log_uniform(rng, 0.02, 0.2)}


def _draw_compression(rng: Rng, s: Situation) -> Values:
    return {"coefficient": log_uniform(rng, 0.03, 0.25) / s.voltage**2}


def _draw_slew(rng: Rng, s: Situation) -> Values:
    return {"slew_rate": s.voltage * s.rate / log_uniform(rng, 1.5, 12.0)}


EFFECTS = (
    Effect(
        name="periodic-external-torque",
        equation="mechanical",
        units={"amplitude": "N m", "frequency": "Hz", "phase": "rad"},
        draw=_draw_periodic,
        build=renamed(amplitude="periodic_amplitude", frequency="periodic_frequency", phase="periodic_phase"),
        scale=times("amplitude"),
        linear=frozenset({"phase"}),
        rivals=("load-disturbance", "unbalance"),
        named=False,
    ),
    Effect(
        name="cubic-drag",
        equation="mechanical",
        units={"coefficient": "N m s^3/rad^3"},
        draw=_draw_cubic,
        build=renamed(coefficient="cubic_drag"),
        scale=times("coefficient"),
        rivals=("quadratic-drag", "voltage-saturation", "magnetic-saturation"),
        named=False,
        known_as="power-law-drag",
    ),
    Effect(
        name="square-root-drag",
        equation="mechanical",
        units={"coefficient": "N m s^0.5/rad^0.5"},
        draw=_draw_root,
        build=renamed(coefficient="root_drag"),
        scale=times("coefficient"),
        rivals=("coulomb-friction", "stribeck-friction", "quadratic-drag", "brush-voltage-drop"),
        named=False,
        known_as="power-law-drag",
    ),
    Effect(
        name="torque-constant-drift",
        equation="electrical",
        units={"rate": "1/s"},
        draw=_draw_flux,
        build=renamed(rate="flux_drift"),
        scale=times("rate"),
        linear=frozenset({"rate"}),
        rivals=("resistance-heating", "load-disturbance"),
        named=False,
    ),
    Effect(
        name="viscous-friction-drift",
        equation="mechanical",
        units={"excess": "N m s/rad", "time_constant": "s"},
        draw=_draw_warming,
        build=renamed(excess="viscous_excess", time_constant="viscous_time"),
        scale=times("excess"),
        rivals=("resistance-heating", "load-disturbance"),
        named=False,
    ),
    Effect(
        name="reluctance-torque",
        equation="mechanical",
        units={"coefficient": "N m/A^2"},
        draw=_draw_reluctance,
        build=renamed(coefficient="reluctance_torque"),
        scale=times("coefficient"),
        rivals=("asymmetric-friction", "load-disturbance", "sensor-bias"),
        named=False,
    ),
    Effect(
        name="amplifier-compression",
        equation="actuator",
        units={"coefficient": "1/V^2"},
        draw=_draw_compression,
        build=renamed(coefficient="compression"),
        scale=times("coefficient"),
        rivals=("voltage-saturation", "quadratic-drag", "magnetic-saturation"),
        named=False,
        known_as="amplifier-gain-curve",
    ),
    Effect(
        name="slew-rate-limit",
        equation="actuator",
        units={"slew_rate": "V/s"},
        draw=_draw_slew,
        build=renamed(slew_rate="slew_rate"),
        scale=times("slew_rate", power=-1.0),
        rivals=("input-delay", "speed-sensor-lag"),
        named=False,
    ),
)
