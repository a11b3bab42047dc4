"""Dry friction and drag."""

from __future__ import annotations

import numpy as np

from rwn.studies.trials.effects.definition import Effect, Situation, log_uniform, phase, renamed, times
from rwn.studies.trials.plant import Values

Rng = np.random.Generator


def _coulomb(values: Values, _: Values) -> Values:
    return {"coulomb_plus": values["coulomb_torque"], "coulomb_minus": values["coulomb_torque"]}


def _draw_coulomb(rng: Rng, s: Situation) -> Values:
    return {"coulomb_torque": s.torque * log_uniform(rng, 0.03, 0.3)}


def _draw_stribeck(rng: Rng, s: Situation) -> Values:
    return {
        "coulomb_torque": s.coulomb,
        "static_torque": s.coulomb * (1.0 + log_uniform(rng, 0.1, 0.7)),
        "stribeck_speed": s.speed * log_uniform(rng, 0.05, 0.4),
    }


def _stribeck(values: Values, nominal: Values) -> Values:
    excess = values["static_torque"] - values["coulomb_torque"]
    return _coulomb(values, nominal) | {
        "stribeck_excess": excess,
        "stribeck_speed": values["stribeck_speed"],
    }


def _scale_stribeck(values: Values, factor: float) -> Values:
    level = values["coulomb_torque"]
    return values | {"static_torque": level + factor * (values["static_torque"] - level)}


def _draw_asymmetric(rng: Rng, s: Situation) -> Values:
    half = log_uniform(rng, 0.05, 0.4) * (1.0 if rng.random() < 0.5 else -1.0)
    return {"coulomb_torque_plus": s.coulomb * (1 + half), "coulomb_torque_minus": s.coulomb * (1 - half)}


def _scale_asymmetric(values: Values, factor: float) -> Values:
    mean = 0.5 * (values["coulomb_torque_plus"] + values["coulomb_torque_minus"])
    return {name: mean + factor * (value - mean) for name, value in values.items()}


def _draw_load_dependent(rng: Rng, _: Situation) -> Values:
    return {"friction_ratio": log_uniform(rng, 0.02, 0.2)}


def _draw_presliding(rng: Rng, s: Situation) -> Values:
    stiffness = s.coulomb / log_uniform(rng, 0.02, 0.3)  # slides after this angle [rad]
    damping = 2.0 * rng.uniform(0.1, 0.5) * float(np.sqrt(stiffness * s.motor.inertia))
    return {"bristle_stiffness": stiffness, "bristle_damping": damping}


def _scale_presliding(values: Values, factor: float) -> Values:
    return {
        "bristle_stiffness": values["bristle_stiffness"] / factor,
        "bristle_damping": values["bristle_damping"] / factor**0.5,
    }


def _draw_position(rng: Rng, s: Situation) -> Values:
    return {"coulomb_torque": s.coulomb, "variation": rng.uniform(0.1, 0.6), "phase": phase(rng)}


def _position(values: Values, nominal: Values) -> Values:
    return _coulomb(values, nominal) | {
        "friction_variation": values["variation"],
        "friction_phase": values["phase"],
    }


def _draw_drag(rng: Rng, s: Situation) -> Values:
    return {"drag_coefficient": s.torque / s.speed**2 * log_uniform(rng, 0.02, 0.3)}


EFFECTS = (
    Effect(
        name="coulomb-friction",
        equation="mechanical",
        units={"coulomb_torque": "N m"},
        draw=_draw_coulomb,
        build=_coulomb,
        scale=times("coulomb_torque"),
        suits=lambda s: not s.dry,
        rivals=(
            "brush-voltage-drop",
            "actuator-deadzone",
            "load-dependent-friction",
            "square-root-drag",
            "quadratic-drag",
        ),
        replaces_coulomb=True,
    ),
    Effect(
        name="stribeck-friction",
        equation="mechanical",
        units={"coulomb_torque": "N m", "static_torque": "N m", "stribeck_speed": "rad/s"},
        draw=_draw_stribeck,
        build=_stribeck,
        scale=_scale_stribeck,
        suits=lambda s: s.dry,
        rivals=(
            "presliding-hysteresis",
            "brush-voltage-drop",
            "load-dependent-friction",
            "actuator-deadzone",
            "quadratic-drag",
        ),
        replaces_coulomb=True,
        slow=True,
    ),
    Effect(
        name="asymmetric-friction",
        equation="mechanical",
        units={"coulomb_torque_plus": "N m", "coulomb_torque_minus": "N m"},
        draw=_draw_asymmetric,
        build=renamed(coulomb_torque_plus="coulomb_plus", coulomb_torque_minus="coulomb_minus"),
        scale=_scale_asymmetric,
        suits=lambda s: s.dry,
        limits={"coulomb_torque_plus": (0.0, np.inf), "coulomb_torque_minus": (0.0, np.inf)},
        rivals=("sensor-bias", "load-disturbance", "unbalance"),
        replaces_coulomb=True,
    ),
    Effect(
        name="load-dependent-friction",
        equation="mechanical",
        units={"friction_ratio": "1"},
        draw=_draw_load_dependent,
        build=renamed(friction_ratio="friction_ratio"),
        scale=times("friction_ratio"),
        limits={"friction_ratio": (0.0, 0.6)},
        rivals=("coulomb-friction", "stribeck-friction", "magnetic-saturation", "brush-voltage-drop"),
    ),
    Effect(
        name="presliding-hysteresis",
        equation="mechanical",
        units={"bristle_stiffness": "N m/rad", "bristle_damping": "N m s/rad"},
        draw=_draw_presliding,
        build=renamed(bristle_stiffness="bristle_stiffness", bristle_damping="bristle_damping"),
        scale=_scale_presliding,
        suits=lambda s: s.dry,
        rivals=("stribeck-friction", "backlash", "load-dependent-friction", "shaft-compliance"),
        slow=True,
    ),
    Effect(
        name="position-dependent-friction",
        equation="mechanical",
        units={"coulomb_torque": "N m", "variation": "1", "phase": "rad"},
        draw=_draw_position,
        build=_position,
        scale=times("variation"),
        suits=lambda s: s.dry,
        limits={"variation": (0.0, 1.0)},
        linear=frozenset({"phase"}),
        rivals=("unbalance", "inertia-variation", "cogging-torque"),
        replaces_coulomb=True,
        slow=True,
    ),
    Effect(
        name="quadratic-drag",
        equation="mechanical",
        units={"drag_coefficient": "N m s^2/rad^2"},
        draw=_draw_drag,
        build=renamed(drag_coefficient="quadratic_drag"),
        scale=times("drag_coefficient"),
        rivals=(
            "cubic-drag",
            "voltage-saturation",
            "magnetic-saturation",
            "load-dependent-friction",
            "coulomb-friction",
        ),
    ),
)
