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
  double flux_drift = 0.0;  // Kt and Ke times 1 + this t
  // Actuator.
  double delay = 0.0;
  double compression = 0.0;  // v (1 - this v^2)
  double deadzone = 0.0;
  double voltage_limit = std::numeric_limits<double>::infinity();
  double slew_rate = std::numeric_limits<double>::infinity();
  // Sensor.
  double speed_lag = 0.0;
  double rectification = 0.0;  // not 0: |w| is reported
  double speed_offset = 0.0;
  double current_offset = 0.0;
  double speed_quantum = 0.0;
};

struct PlantParameterName {
  std::string_view name;
  double PlantParameters::* member;
};

/// Every parameter by name, in the order of the struct.
const std::vector<PlantParameterName>& plant_parameter_names();

}  // namespace rwn
