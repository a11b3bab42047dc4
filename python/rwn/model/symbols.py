"""The symbol that each parameter of an effect has in the effect's equation.

Own effects need none: their formulas are written in the parameters' names.
"""

from __future__ import annotations

_OF_EFFECT: dict[str, dict[str, str]] = {
    "viscous-friction": {"damping": "b"},
    "coulomb-friction": {"coulomb_torque": "T_c"},
    "stribeck-friction": {"coulomb_torque": "T_c", "static_torque": "T_s", "stribeck_speed": "w_s"},
    "asymmetric-friction": {"coulomb_torque_plus": "T_c+", "coulomb_torque_minus": "T_c-"},
    "viscous-asymmetry": {"difference": "d"},
    "quadratic-drag": {"drag_coefficient": "k"},
    "power-law-drag": {"drag_torque": "T_d", "exponent": "n", "reference_speed": "w_r"},
    "load-dependent-friction": {"friction_ratio": "mu"},
    "presliding-hysteresis": {"bristle_stiffness": "s0", "bristle_damping": "s1", "coulomb_torque": "T_c"},
    "position-dependent-friction": {"coulomb_torque": "T_c", "variation": "a", "phase": "p"},
    "cogging-torque": {"amplitude": "A", "periods_per_rev": "N", "phase": "p"},
    "unbalance": {"amplitude": "A", "phase": "p"},
    "constant-load": {"torque": "T_l"},
    "load-disturbance": {"torque": "T_d", "t_start": "t_start", "t_end": "t_end"},
    "backlash": {"gap": "gap", "load_inertia": "J_L", "load_viscous_share": "s"},
    "shaft-compliance": {"stiffness": "k", "damping": "c", "load_inertia": "J_L", "load_viscous_share": "s"},
    "inertia-variation": {"amplitude": "J_2"},
    "brush-voltage-drop": {"voltage_drop": "V_b", "transition_current": "i_b"},
    "coasting-bridge": {"share": "s", "supply": "V_s"},
    "resistance-heating": {"thermal_resistance": "R_th", "heat_capacity": "C_th", "temperature_coefficient": "alpha"},
    "magnetic-saturation": {"saturation_current": "i_s"},
    "torque-ripple": {"amplitude": "a", "harmonic": "N", "phase": "p"},
    "actuator-deadzone": {"deadzone": "V_d"},
    "voltage-saturation": {"limit": "V_m"},
    "amplifier-gain-curve": {"gain_change": "g", "exponent": "n", "reference_command": "V_r"},
    "input-delay": {"delay": "d"},
    "speed-sensor-lag": {"time_constant": "tau"},
    "current-sensor-lag": {"time_constant": "tau"},
    "sensor-rectification": {"exponent": "e", "reference_speed": "w_r"},
    "sensor-bias": {"speed_offset": "b_w", "current_offset": "b_i"},
    "sensor-quantization": {"resolution": "q"},
}


def symbol_of(effect: str, parameter: str) -> str:
    """ "T_c"; empty where the equation has none for it (the rate of a contact stands for its stiffness)."""
    return _OF_EFFECT.get(effect, {}).get(parameter, "")
