// The independent plant of the blind trials: a brushed DC motor with every effect as plain physics.
//
// It shares no code with the diagnosing model on purpose: fourth-order Runge-Kutta at a fixed fine step, dry friction
// as a hybrid automaton (slides in one direction, or sticks) whose reversals are located inside the step.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "plant/plant_parameters.hpp"
#include "plant/wander.hpp"

namespace rwn {

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
  void step(double voltage) { step(voltage, {}); }
  /// The same, and fills `seen` with what is measured at as many instants evenly over it, the first at its beginning.
  void step(double voltage, std::span<PlantSample> seen);
  /// One sample time with the power stage off and the rotor held: time goes on, nothing moves.
  void wait();
  int substeps() const { return substeps_; }

 private:
  enum Index : std::size_t {
    current,
    speed,
    position,
    load_speed,
    load_position,
    bristle,
    heat,
    lagged,
    absorber_speed,
    absorber_position,
    size
  };
  using State = std::array<double, size>;
  enum class Contact { backward = -1, sticks = 0, forward = 1, frictionless = 2 };

  struct Electrics {
    double current_rate, torque, heating;
  };

  double fastest_rate(double voltage_scale) const;
  double applied(double command) const;
  Electrics electrics(const State& x, double t) const;
  double friction_level(const State& x, double t, double torque, double direction) const;
  double shaft_torque(const State& x) const;
  double absorber_torque(const State& x) const;
  double rotor_inertia() const { return p_.inertia - p_.load_inertia - p_.absorber_inertia; }
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
  Wander wander_;
  bool two_mass_, lugre_, dry_;
  std::size_t whole_delay_;
  double fraction_delay_;
  State x_{};
  Contact contact_ = Contact::frictionless;
  double voltage_ = 0.0;       // at the terminals, during the present step
  double limit_ = 0.0;         // of that voltage, during the present step
  double slope_ = 0.0;         // of that voltage, where the driver's slew rate limits it
  double voltage_time_ = 0.0;  // when voltage_ held
  bool loaded_ = false;        // inside the window of the load disturbance
  long long row_ = 0;
  std::vector<double> commands_;  // ring of the last whole_delay_ + 2 commands
  std::vector<double> edges_;     // instants of the present step where something changes or is looked at
};

}  // namespace rwn
