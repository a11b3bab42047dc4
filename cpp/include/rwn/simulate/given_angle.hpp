// The angle that angle-dependent effects follow in place of the simulated one.
#pragma once

#include "rwn/simulate/simulation_slice.hpp"

namespace rwn {

/// Recorded, or the integral of a recorded speed. That turns with its sensor's errors; the simulated reading,
/// integrated likewise, takes them out. It starts at the initial position.
template <class S>
struct GivenAngle {
  S first{0.0};   // initial position, where the given angle is counted from it
  S jumped{0.0};  // how far restarts have moved the position

  /// Integrates the simulated reading of the speed as the recorded one was integrated.
  void integrate(const SimulationSlice& slice, int k, const S& shown) {
    if (k > 0) turned_ += 0.5 * (slice.time[k] - slice.time[k - 1]) * (shown_ + shown);
    shown_ = shown;
  }

  /// The angle minus the simulated position at sample k.
  S offset(const SimulationSlice& slice, int k, const S& position) const {
    const double given = slice.angle[k];
    return slice.settings.angle_from_speed ? given - turned_ - jumped : given + first - position;
  }

 private:
  S shown_{0.0}, turned_{0.0};  // simulated reading of the speed, and its integral
};

}  // namespace rwn
