"""Torques of position and time, and what hangs on the shaft."""

from __future__ import annotations

import numpy as np

from rwn.studies.trials.effects.definition import Effect, Situation, log_uniform, phase, renamed, times
from rwn.studies.trials.plant import Values

Rng = np.random.Generator

PERIODS = (3, 5, 6, 7, 8, 9, 10, 12, 14, 16, 18, 20, 22, 24, 28)


def draw_periods(rng: Rng) -> float:
    return float(PERIODS[int(rng.integers(len(PERIODS)))])


def _draw_cogging(rng: Rng, s: Situation) -> Values:
    return {
        "amplitude": s.torque * log_uniform(rng, 0.05, 0.5),
        "periods_per_rev": draw_periods(rng),
        "phase": phase(rng),
    }


def _draw_unbalance(rng: Rng, s: Situation) -> Values:
    return {"amplitude": s.torque * log_uniform(rng, 0.05, 0.4), "phase": phase(rng)}


def _draw_load(rng: Rng, s: Situation) -> Values:
    start = s.duration * rng.uniform(0.1, 0.5)
    sign = 1.0 if rng.random() < 0.5 else -1.0
    return {
        "torque": sign * s.torque * log_uniform(rng, 0.05, 0.4),
        "t_start": start,
        "t_end": start + s.duration * rng.uniform(0.12, 0.4),
    }


def _draw_inertia(rng: Rng, s: Situation) -> Values:
    return {"amplitude": s.motor.inertia * log_uniform(rng, 0.05, 0.3)}


def _reduced(load: float, whole: float) -> float:
    return load * (whole - load) / whole


def _draw_shaft(rng: Rng, s: Situation) -> Values:
    load = s.motor.inertia * rng.uniform(0.2, 0.6)
    reduced = _reduced(load, s.motor.inertia)
    resonance = min(log_uniform(rng, 3.0, 12.0) / s.motor.time_constant, 0.8 * s.rate)  # rad/s
    return {
        "stiffness": reduced * resonance**2,
        "damping": 2.0 * log_uniform(rng, 0.01, 0.1) * reduced * resonance,
        "load_inertia": load,
        "load_viscous_share": rng.uniform(0.0, 0.9),
    }


def _scale_shaft(values: Values, factor: float) -> Values:
    return values | {
        "stiffness": values["stiffness"] / factor,
        "damping": values["damping"] / factor**0.5,
    }


def _behind(load: float, values: Values, nominal: Values) -> Values:
    share = values["load_viscous_share"]
    return {"load_inertia": load, "load_viscous": share * nominal["viscous_friction"]}


def _shaft(values: Values, nominal: Values) -> Values:
    load = min(values["load_inertia"], 0.97 * nominal["inertia"])
    return _behind(load, values, nominal) | {"stiffness": values["stiffness"], "damping": values["damping"]}


def _draw_backlash(rng: Rng, s: Situation) -> Values:
    return {
        "gap": min(s.speed * s.motor.time_constant * log_uniform(rng, 0.03, 0.5), 0.5),
        "load_inertia": s.motor.inertia * rng.uniform(0.25, 0.6),
        # The closed gap: teeth on a stiff shaft, faster than any drive of the table [rad/s], damping.
        "contact_rate": log_uniform(rng, 800.0, 2500.0),
        "contact_damping": rng.uniform(0.2, 0.6),
        "load_viscous_share": rng.uniform(0.0, 0.9),
    }


def _backlash(values: Values, nominal: Values) -> Values:
    load = min(values["load_inertia"], 0.97 * nominal["inertia"])
    reduced = _reduced(load, nominal["inertia"])
    return _behind(load, values, nominal) | {
        "gap": values["gap"],
        "stiffness": reduced * values["contact_rate"] ** 2,
        "damping": 2.0 * values["contact_damping"] * reduced * values["contact_rate"],
    }


EFFECTS = (
    Effect(
        name="cogging-torque",
        equation="mechanical",
        units={"amplitude": "N m", "periods_per_rev": "1", "phase": "rad"},
        draw=_draw_cogging,
        build=renamed(
            amplitude="cogging_amplitude", periods_per_rev="cogging_periods", phase="cogging_phase"
        ),
        scale=times("amplitude"),
        linear=frozenset({"phase"}),
        fixed=frozenset({"periods_per_rev"}),
        rivals=("torque-ripple", "unbalance"),
        slow=True,
    ),
    Effect(
        name="unbalance",
        equation="mechanical",
        units={"amplitude": "N m", "phase": "rad"},
        draw=_draw_unbalance,
        build=renamed(amplitude="unbalance_amplitude", phase="unbalance_phase"),
        scale=times("amplitude"),
        linear=frozenset({"phase"}),
        rivals=("position-dependent-friction", "inertia-variation", "torque-ripple"),
        slow=True,
    ),
    Effect(
        name="load-disturbance",
        equation="mechanical",
        units={"torque": "N m", "t_start": "s", "t_end": "s"},
        draw=_draw_load,
        build=renamed(torque="load_torque", t_start="load_start", t_end="load_end"),
        scale=times("torque"),
        linear=frozenset({"torque"}),
        rivals=("asymmetric-friction", "sensor-bias", "torque-constant-drift"),
    ),
    Effect(
        name="inertia-variation",
        equation="mechanical",
        units={"amplitude": "kg m^2"},
        draw=_draw_inertia,
        build=renamed(amplitude="inertia_variation"),
        scale=times("amplitude"),
        linear=frozenset({"amplitude"}),
        rivals=("unbalance", "torque-ripple", "cogging-torque"),
        slow=True,
    ),
    Effect(
        name="backlash",
        equation="mechanical",
        units={"gap": "rad", "load_inertia": "kg m^2", "load_viscous_share": "1"},
        draw=_draw_backlash,
        build=_backlash,
        scale=times("gap"),
        limits={"gap": (0.0, 3.0), "load_viscous_share": (0.0, 1.0)},
        fixed=frozenset({"contact_rate", "contact_damping"}),
        rivals=("shaft-compliance", "presliding-hysteresis"),
        two_mass=True,
    ),
    Effect(
        name="shaft-compliance",
        equation="mechanical",
        units={
            "stiffness": "N m/rad", "damping": "N m s/rad", "load_inertia": "kg m^2", "load_viscous_share": "1",
        },
        draw=_draw_shaft,
        build=_shaft,
        scale=_scale_shaft,
        limits={"load_viscous_share": (0.0, 1.0)},
        rivals=("backlash", "speed-sensor-lag", "input-delay"),
        two_mass=True,
    ),
)
