// The independent plant of the blind trials: a brushed DC motor with every effect as plain physics.
//
// It shares no code with the diagnosing model on purpose: fourth-order Runge-Kutta at a fixed fine step, dry friction
// as a hybrid automaton (slides in one direction, or sticks) whose reversals are located inside the step.
#pragma once

#include <array>
#include <cstddef>
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
  // A tuned mass hanging on the rotor, in addition to `inertia`.
  double absorber_inertia = 0.0;
  double absorber_stiffness = 0.0;
  double absorber_damping = 0.0;
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

/// One row of a recording without noise: truth first, then what the sensors say.
struct PlantSample {
  double current, speed, position, sensed_current, sensed_speed, temperature_rise;
};
inline constexpr std::size_t plant_sample_width = 6;

class Plant {
 public:
  /// `substeps` is the least number of Runge-Kutta steps per sample and `fineness` the largest step times the fastest
  /// rate of the plant; `voltage_scale` is the largest voltage to expect (it bounds the speed).
  Plant(const PlantParameters& parameters, double sample_time, double voltage_scale, int substeps, double fineness);

  /// At rest, position 0, no current, ambient temperature, time 0.
  void reset();
  /// What is measured now, before a new voltage acts.
  PlantSample sample() const;
  /// Commands `voltage` from now on and advances by one sample time.
  void step(double voltage);
  int substeps() const { return substeps_; }

 private:
  enum Index : std::size_t { current, speed, position, load_speed, load_position, bristle, heat, lagged, absorber_speed, absorber_twist, size };
  using State = std::array<double, size>;
  enum class Contact { backward = -1, sticks = 0, forward = 1, frictionless = 2 };

  struct Electrics {
    double current_rate, torque, heating;
  };

  double fastest_rate(double voltage_scale) const;
  double applied(double command) const;
  Electrics electrics(const State& x, double t) const;
  double friction_level(const State& x, double torque, double direction) const;
  double shaft_torque(const State& x) const;
  double loads(const State& x, double t) const;
  State derivative(const State& x, double t) const;
  State runge_kutta(const State& x, double t, double h) const;
  double free_torque(const State& x, double t) const;
  void settle_contact(double t);
  void advance(double t, double h);
  double reversal(double t, double h, State& landed) const;
  void segment(double begin, double end, double command);

  PlantParameters p_;
  double sample_time_;
  int substeps_;
  bool two_mass_, lugre_, dry_;
  std::size_t whole_delay_;
  double fraction_delay_;
  State x_{};
  Contact contact_ = Contact::frictionless;
  double voltage_ = 0.0;       // at the terminals, during the present step
  double slope_ = 0.0;         // of that voltage, where the driver's slew rate limits it
  double voltage_time_ = 0.0;  // when voltage_ held
  bool loaded_ = false;        // inside the window of the load disturbance
  long long row_ = 0;
  std::vector<double> commands_;  // ring of the last whole_delay_ + 2 commands
};

}  // namespace rwn
