// What the independent plant of the blind trials can do.
#pragma once

#include <limits>
#include <string_view>
#include <vector>

namespace rwn {

/// Everything that the plant can do; the defaults switch every effect off. SI units.
struct PlantParameters {
  // The motor: L di/dt = v - R i - Ke w, J dw/dt = Kt i - B w.
  double resistance = 1.0;
  double inductance = 1e-3;
  double torque_constant = 0.05;
  double back_emf_constant = 0.05;
  double inertia = 1e-4;
  double viscous_friction = 0.0;
  // Dry friction, level (Tc + (Ts - Tc) exp(-(w/ws)^2)) (1 + a cos(theta + p)) + mu |Kt i|.
  double coulomb_plus = 0.0;
  double coulomb_minus = 0.0;
  double stribeck_excess = 0.0;  // Ts - Tc
  double stribeck_speed = 1.0;
  double friction_variation = 0.0;
  double friction_phase = 0.0;
  double friction_ratio = 0.0;
  double friction_drift = 0.0;  // level times 1 + this t
  double friction_wave = 0.0;   // level times 1 + this sum of cos(n theta + phase n), n = 2, 3, 5
  double friction_wave_phase_2 = 0.0;
  double friction_wave_phase_3 = 0.0;
  double friction_wave_phase_5 = 0.0;
  double iron_loss = 0.0;  // added to the level: this |i|^exponent
  double iron_exponent = 1.6;
  double bristle_stiffness = 0.0;  // above 0 the friction is LuGre instead: dz/dt = w - s0 |w| z / level
  double bristle_damping = 0.0;
  // Torques.
  double quadratic_drag = 0.0;
  double cubic_drag = 0.0;
  double root_drag = 0.0;
  double cogging_amplitude = 0.0;
  double cogging_periods = 1.0;
  double cogging_phase = 0.0;
  double unbalance_amplitude = 0.0;
  double unbalance_phase = 0.0;
  double load_torque = 0.0;
  double load_start = 0.0;
  double load_end = 0.0;
  double inertia_variation = 0.0;  // J + J2 cos(2 theta)
  double periodic_amplitude = 0.0;
  double periodic_frequency = 1.0;
  double periodic_phase = 0.0;
  double reluctance_torque = 0.0;  // times i^2
  double viscous_excess = 0.0;     // B + this exp(-t / time)
  double viscous_time = 1.0;
  double band_drag = 0.0;          // drag sign(w) exp(-((|w| - speed) / width)^2)
  double band_speed = 0.0;
  double band_width = 1.0;
  double eccentric_drag = 0.0;     // times w cos(theta + phase)
  double eccentric_phase = 0.0;
  double load_spring = 0.0;        // times theta
  double added_inertia = 0.0;      // times |w|: J + this |w|
  double wander_torque = 0.0;      // rms of an Ornstein-Uhlenbeck process with this correlation time
  double wander_time = 1.0;
  double wander_seed = 0.0;
  // A small mass on a spring on the rotor; a part of `inertia`.
  double absorber_inertia = 0.0;
  double absorber_stiffness = 0.0;
  double absorber_damping = 0.0;
  // Second mass: `inertia` is the whole; this much of it, and of the viscous friction, sits behind the shaft.
  double load_inertia = 0.0;
  double load_viscous = 0.0;
  double stiffness = 0.0;
  double damping = 0.0;
  double gap = 0.0;
  // Electrical.
  double brush_drop = 0.0;
  double brush_current = 0.1;
  double thermal_resistance = 1.0;
  double heat_capacity = 1.0;
  double temperature_coefficient = 0.0;
  double saturation_current = std::numeric_limits<double>::infinity();
  double ripple_amplitude = 0.0;
  double ripple_harmonic = 1.0;
  double flux_drift = 0.0;         // Kt and Ke times 1 + this t
  double flux_temperature = 0.0;   // Kt and Ke times 1 - this times the temperature rise
  // Actuator.
  double delay = 0.0;
  double compression = 0.0;  // v (1 - this v^2)
  double deadzone = 0.0;
  double voltage_limit = std::numeric_limits<double>::infinity();
  double slew_rate = std::numeric_limits<double>::infinity();
  double supply_resistance = 0.0;  // the voltage limit falls by this |i|, taken when a command begins to act
  double supply_ripple = 0.0;      // the terminal voltage times 1 + this sin(2 pi f t)
  double supply_ripple_frequency = 1.0;
  // Sensor.
  double speed_lag = 0.0;
  double rectification = 0.0;  // not 0: |w| is reported
  double speed_offset = 0.0;
  double current_offset = 0.0;
  double speed_quantum = 0.0;
  double eccentricity = 0.0;  // w (1 + this sin(theta + phase)) is reported
  double eccentricity_phase = 0.0;
};

struct PlantParameterName {
  std::string_view name;
  double PlantParameters::* member;
};

/// Every parameter by name, in the order of the struct.
const std::vector<PlantParameterName>& plant_parameter_names();

}  // namespace rwn
