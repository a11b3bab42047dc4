"""A parameter set of the plant as a MuJoCo model (MJCF), for the laws that both have.

| plant                                    | MuJoCo                                                              |
|------------------------------------------|---------------------------------------------------------------------|
| resistance, inductance, torque_constant  | dcmotor resistance, inductance, motorconst (Kt = Ke)                |
| inertia, viscous friction, cubic drags   | inertia about a hinge, its damping (a, b, c): a w + b w abs(w) + c w^3 |
| coulomb_plus = coulomb_minus             | frictionloss of the hinge                                           |
| bristle_stiffness, bristle_damping       | dcmotor lugre, with Coulomb = static friction; no frictionloss then |
| cogging_*                                | dcmotor cogging, which drives where ours brakes: phase + pi         |
| unbalance_*                              | a centre of mass off the hinge, under gravity                       |
| load_spring                              | stiffness of the hinge                                              |
| thermal_resistance, heat_capacity, ...   | dcmotor thermal, ambient = reference temperature                    |
| load_inertia, stiffness, damping         | a second hinge, held to the first by a fixed tendon                 |
| absorber_*                               | a third one                                                         |
| voltage_limit without a sagging supply   | ctrlrange                                                           |
| load_*, periodic_*                       | torques of time, applied to the hinge from outside                  |
| supply_resistance                        | limits the command once a tick, outside, as ours does               |
"""

from __future__ import annotations

import numpy as np

from rwn.studies.trials.plant import Values

PARAMETERS = frozenset({
    "resistance", "inductance", "torque_constant", "back_emf_constant", "inertia", "viscous_friction",
    "quadratic_drag", "cubic_drag", "coulomb_plus", "coulomb_minus", "bristle_stiffness", "bristle_damping",
    "cogging_amplitude", "cogging_periods", "cogging_phase", "unbalance_amplitude", "unbalance_phase", "load_spring",
    "thermal_resistance", "heat_capacity", "temperature_coefficient", "load_inertia", "load_viscous", "stiffness",
    "damping", "absorber_inertia", "absorber_stiffness", "absorber_damping", "voltage_limit", "supply_resistance",
    "load_torque", "load_start", "load_end", "periodic_amplitude", "periodic_frequency", "periodic_phase",
})  # fmt: skip
EFFECTS = frozenset({
    "coulomb-friction", "presliding-hysteresis", "quadratic-drag", "cogging-torque", "unbalance", "load-disturbance",
    "shaft-compliance", "resistance-heating", "voltage-saturation", "periodic-external-torque", "cubic-drag",
    "load-spring", "second-resonance", "supply-sag",
})  # fmt: skip
GRAVITY = 9.81
PENDULUM = 0.05  # of the inertia that the eccentric mass makes
RIGID = "0.9999 0.9999 0.001 0.5 2"  # impedance of dry friction: it sticks to within a ten-thousandth


def describes(plant: Values) -> bool:
    """Whether a model can be made of it: known laws, one torque constant, one level of dry friction."""
    return (
        set(plant) <= PARAMETERS
        and plant["torque_constant"] == plant["back_emf_constant"]
        and plant.get("coulomb_plus", 0.0) == plant.get("coulomb_minus", 0.0)
    )


def model(plant: Values, step: float) -> str:
    """The MJCF text, for integration steps of `step` [s]."""
    p = dict.fromkeys(PARAMETERS, 0.0) | plant
    others = [
        ("load", p["load_inertia"], p["load_viscous"], p["stiffness"], p["damping"]),
        ("absorber", p["absorber_inertia"], 0.0, p["absorber_stiffness"], p["absorber_damping"]),
    ]
    others = [other for other in others if other[1] > 0.0]
    bodies = [_rotor(p, step)]
    bodies += [_body(name, f'damping="{drag!r}"', _inertial(mass)) for name, mass, drag, _, _ in others]
    tendons = [
        f'<fixed stiffness="{k!r}" damping="{c!r}" springlength="0 0">'
        f'<joint joint="rotor" coef="1"/><joint joint="{name}" coef="-1"/></fixed>'
        for name, _, _, k, c in others
    ]
    return (
        f'<mujoco><option timestep="{step!r}" gravity="0 0 {-GRAVITY}" integrator="Euler">'
        f'<flag contact="disable"/></option><worldbody>{"".join(bodies)}</worldbody>'
        f"<tendon>{''.join(tendons)}</tendon><actuator>{_motor(p, 'voltage_limit' in plant)}</actuator></mujoco>"
    )


def _body(name: str, joint: str, inertial: str) -> str:
    return f'<body><joint name="{name}" type="hinge" axis="0 1 0" {joint}/>{inertial}</body>'


def _inertial(inertia: float, mass: float = 1.0, at: tuple[float, float] = (0.0, 0.0)) -> str:
    moments = " ".join([repr(inertia)] * 3)
    return f'<inertial pos="{at[0]!r} 0 {at[1]!r}" mass="{mass!r}" diaginertia="{moments}"/>'


def _rotor(p: Values, step: float) -> str:
    inertia = p["inertia"] - p["load_inertia"] - p["absorber_inertia"]
    drag = p["viscous_friction"] - p["load_viscous"]
    level = 0.0 if p["bristle_stiffness"] else p["coulomb_plus"]
    joint = (
        f'damping="{drag!r} {p["quadratic_drag"]!r} {p["cubic_drag"]!r}" stiffness="{p["load_spring"]!r}" '
        f'frictionloss="{level!r}" solreffriction="{2.0 * step!r} 1" solimpfriction="{RIGID}"'
    )
    torque = p["unbalance_amplitude"]
    if not torque:
        return _body("rotor", joint, _inertial(inertia))
    radius = PENDULUM * inertia * GRAVITY / torque
    at = (-radius * float(np.sin(p["unbalance_phase"])), -radius * float(np.cos(p["unbalance_phase"])))
    mass = torque / (GRAVITY * radius)
    return _body("rotor", joint, _inertial(inertia * (1.0 - PENDULUM), mass, at))


def _motor(p: Values, limited: bool) -> str:
    constant, level = p["torque_constant"], p["coulomb_plus"]
    parts = [f'joint="rotor" motorconst="{constant!r} {constant!r}" resistance="{p["resistance"]!r}"']
    parts.append(f'inductance="{p["inductance"]!r} 0"')
    if p["cogging_amplitude"]:
        parts.append(f'cogging="{p["cogging_amplitude"]!r} {p["cogging_periods"]:g} {p["cogging_phase"] + np.pi!r}"')
    if p["bristle_stiffness"]:
        parts.append(f'lugre="{p["bristle_stiffness"]!r} {p["bristle_damping"]!r} {level!r} {level!r} 1"')
    if p["temperature_coefficient"]:
        heat = f"{p['thermal_resistance']!r} {p['heat_capacity']!r} 0 {p['temperature_coefficient']!r} 20 20"
        parts.append(f'thermal="{heat}"')
    if limited and not p["supply_resistance"]:
        parts.append(f'ctrllimited="true" ctrlrange="{-p["voltage_limit"]!r} {p["voltage_limit"]!r}"')
    return f"<dcmotor {' '.join(parts)}/>"
