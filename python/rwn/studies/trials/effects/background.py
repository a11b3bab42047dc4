"""More physics without a name, for bench trials: small things of real machines beneath, or instead of, a named effect.

A table of their own: the trials of a seed that were made from the other tables stay what they are.
"""

from __future__ import annotations

import numpy as np

from rwn.studies.trials.effects.definition import Effect, Situation, log_uniform, phase, renamed, times
from rwn.studies.trials.plant import Values

Rng = np.random.Generator


def _sign(rng: Rng) -> float:
    return 1.0 if rng.random() < 0.5 else -1.0


def _dry(s: Situation) -> bool:
    return s.dry


def _draw_wander(rng: Rng, s: Situation) -> Values:
    time = s.motor.time_constant * log_uniform(rng, 3.0, 30.0)
    return {"torque": s.torque * log_uniform(rng, 0.02, 0.2), "time": time}


def _draw_friction_drift(rng: Rng, s: Situation) -> Values:
    return {"rate": _sign(rng) * log_uniform(rng, 0.1, 0.6) / s.duration}


def _draw_friction_wave(rng: Rng, _: Situation) -> Values:
    return {"variation": log_uniform(rng, 0.05, 0.3)} | {f"phase_{n}": phase(rng) for n in (2, 3, 5)}


def _draw_added_inertia(rng: Rng, s: Situation) -> Values:
    return {"coefficient": s.motor.inertia / s.speed * log_uniform(rng, 0.02, 0.3)}


def _draw_supply_ripple(rng: Rng, s: Situation) -> Values:
    return {"amplitude": log_uniform(rng, 0.01, 0.15), "frequency": log_uniform(rng, 0.05, 0.5) / s.motor.time_constant}


def _draw_supply_sag(rng: Rng, s: Situation) -> Values:
    resistance = s.voltage / s.current_peak * log_uniform(rng, 0.05, 0.3)
    return {"open_circuit_voltage": s.voltage * rng.uniform(0.9, 1.05), "internal_resistance": resistance}


def _draw_warm_magnet(rng: Rng, s: Situation) -> Values:
    settled = log_uniform(rng, 0.03, 0.2)  # of the flux, lost after a long time at this current
    resistance = 60.0 / (s.motor.resistance * s.current**2)
    return {
        "temperature_coefficient": settled / 60.0,
        "thermal_resistance": resistance,
        "heat_capacity": s.duration * log_uniform(rng, 0.2, 2.0) / resistance,
    }


def _draw_iron(rng: Rng, s: Situation) -> Values:
    exponent = rng.uniform(1.5, 2.0)
    return {"coefficient": s.torque / s.current**exponent * log_uniform(rng, 0.02, 0.2), "exponent": exponent}


def _draw_band(rng: Rng, s: Situation) -> Values:
    centre = s.speed * rng.uniform(0.5, 1.5)
    return {"torque": s.torque * log_uniform(rng, 0.03, 0.3), "speed": centre, "width": centre * rng.uniform(0.1, 0.3)}


def _draw_eccentric_drag(rng: Rng, s: Situation) -> Values:
    return {"coefficient": s.torque / s.speed * log_uniform(rng, 0.05, 0.5), "phase": phase(rng)}


def _draw_spring(rng: Rng, s: Situation) -> Values:
    return {"stiffness": s.torque / (s.speed * s.motor.time_constant) * log_uniform(rng, 0.002, 0.05)}


def _draw_absorber(rng: Rng, s: Situation) -> Values:
    return {
        "inertia_share": rng.uniform(0.02, 0.1),
        "resonance": min(log_uniform(rng, 4.0, 20.0) / s.motor.time_constant, 0.8 * s.rate),
        "damping_ratio": log_uniform(rng, 0.02, 0.1),
    }


def _absorber(values: Values, nominal: Values) -> Values:
    mass, resonance = values["inertia_share"] * nominal["inertia"], values["resonance"]
    return {
        "absorber_inertia": mass,
        "absorber_stiffness": mass * resonance**2,
        "absorber_damping": 2.0 * values["damping_ratio"] * mass * resonance,
    }


def _draw_eccentricity(rng: Rng, _: Situation) -> Values:
    return {"eccentricity": log_uniform(rng, 0.005, 0.05), "phase": phase(rng)}


EFFECTS = (
    Effect(
        name="wandering-torque",
        equation="mechanical",
        units={"torque": "N m", "time": "s"},  # rms and correlation time of an Ornstein-Uhlenbeck process
        draw=_draw_wander,
        build=renamed(torque="wander_torque", time="wander_time"),
        scale=times("torque"),
        rivals=("load-disturbance",),
        named=False,
    ),
    Effect(
        name="friction-level-drift",
        equation="mechanical",
        units={"rate": "1/s"},
        draw=_draw_friction_drift,
        build=renamed(rate="friction_drift"),
        scale=times("rate"),
        suits=_dry,
        linear=frozenset({"rate"}),
        rivals=("resistance-heating", "load-disturbance"),
        named=False,
    ),
    Effect(
        name="friction-wave",
        equation="mechanical",
        units={"variation": "1", "phase_2": "rad", "phase_3": "rad", "phase_5": "rad"},  # 2, 3 and 5 waves a turn
        draw=_draw_friction_wave,
        build=renamed(
            variation="friction_wave", phase_2="friction_wave_phase_2", phase_3="friction_wave_phase_3",
            phase_5="friction_wave_phase_5",
        ),
        scale=times("variation"),
        suits=_dry,
        limits={"variation": (0.0, 0.33)},
        linear=frozenset({"phase_2", "phase_3", "phase_5"}),
        rivals=("position-dependent-friction", "unbalance"),
        slow=True,
        named=False,
    ),
    Effect(
        name="added-inertia",
        equation="mechanical",
        units={"coefficient": "kg m^2 s/rad"},  # c |w| dw/dt
        draw=_draw_added_inertia,
        build=renamed(coefficient="added_inertia"),
        scale=times("coefficient"),
        rivals=("quadratic-drag", "inertia-variation", "magnetic-saturation"),
        named=False,
    ),
    Effect(
        name="supply-ripple",
        equation="actuator",
        units={"amplitude": "1", "frequency": "Hz"},  # V (1 + a sin(2 pi f t))
        draw=_draw_supply_ripple,
        build=renamed(amplitude="supply_ripple", frequency="supply_ripple_frequency"),
        scale=times("amplitude"),
        limits={"amplitude": (0.0, 0.4)},
        rivals=("torque-ripple",),
        named=False,
    ),
    Effect(
        name="supply-sag",
        equation="actuator",
        units={"open_circuit_voltage": "V", "internal_resistance": "ohm"},  # |V| <= V0 - R |i|
        draw=_draw_supply_sag,
        build=renamed(open_circuit_voltage="voltage_limit", internal_resistance="supply_resistance"),
        scale=times("internal_resistance", power=0.5),
        rivals=("amplifier-compression", "quadratic-drag", "magnetic-saturation"),
        named=False,
        known_as="supply-sag",
    ),
    Effect(
        name="torque-constant-warming",
        equation="electrical",
        units={"temperature_coefficient": "1/K", "thermal_resistance": "K/W", "heat_capacity": "J/K"},
        draw=_draw_warm_magnet,
        build=renamed(
            temperature_coefficient="flux_temperature", thermal_resistance="thermal_resistance",
            heat_capacity="heat_capacity",
        ),
        scale=times("temperature_coefficient"),
        limits={"temperature_coefficient": (0.0, 0.01)},
        rivals=("resistance-heating", "load-disturbance"),
        named=False,
    ),
    Effect(
        name="iron-hysteresis",
        equation="mechanical",
        units={"coefficient": "N m/A^p", "exponent": "1"},  # sign(w) c |i|^p
        draw=_draw_iron,
        build=renamed(coefficient="iron_loss", exponent="iron_exponent"),
        scale=times("coefficient"),
        rivals=("load-dependent-friction", "coulomb-friction", "magnetic-saturation"),
        named=False,
        known_as="power-law-load-friction",
    ),
    Effect(
        name="speed-band-drag",
        equation="mechanical",
        units={"torque": "N m", "speed": "rad/s", "width": "rad/s"},  # T sign(w) exp(-((|w| - ws) / width)^2)
        draw=_draw_band,
        build=renamed(torque="band_drag", speed="band_speed", width="band_width"),
        scale=times("torque"),
        rivals=("quadratic-drag", "stribeck-friction", "coulomb-friction"),
        named=False,
    ),
    Effect(
        name="eccentric-drag",
        equation="mechanical",
        units={"coefficient": "N m s/rad", "phase": "rad"},  # c w cos(theta + p)
        draw=_draw_eccentric_drag,
        build=renamed(coefficient="eccentric_drag", phase="eccentric_phase"),
        scale=times("coefficient"),
        linear=frozenset({"phase"}),
        rivals=("position-dependent-friction", "unbalance", "inertia-variation"),
        slow=True,
        named=False,
    ),
    Effect(
        name="load-spring",
        equation="mechanical",
        units={"stiffness": "N m/rad"},
        draw=_draw_spring,
        build=renamed(stiffness="load_spring"),
        scale=times("stiffness"),
        rivals=("unbalance", "load-disturbance"),
        named=False,
        known_as="load-spring",
    ),
    Effect(
        name="second-resonance",
        equation="mechanical",
        units={"inertia_share": "1", "resonance": "rad/s", "damping_ratio": "1"},  # of a small mass on the rotor
        draw=_draw_absorber,
        build=_absorber,
        scale=times("inertia_share"),
        limits={"inertia_share": (0.0, 0.3)},
        rivals=("speed-sensor-lag", "input-delay"),
        named=False,
    ),
    Effect(
        name="sensor-eccentricity",
        equation="sensor",
        units={"eccentricity": "1", "phase": "rad"},  # w (1 + a sin(theta + p)) is read
        draw=_draw_eccentricity,
        build=renamed(eccentricity="eccentricity", phase="eccentricity_phase"),
        scale=times("eccentricity"),
        suits=lambda s: not s.encoder,
        limits={"eccentricity": (0.0, 0.3)},
        linear=frozenset({"phase"}),
        rivals=("torque-ripple", "inertia-variation"),
        slow=True,
        named=False,
    ),
)
