// Into which steps an interval of constant input is divided.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "rwn/simulate/winding_level.hpp"

namespace rwn {

// Below this R/L h one step is enough, even where saturation makes the winding seven times as fast as R/L.
inline constexpr double angle_of_a_slow_winding = angle_of_a_winding / 7.0;

/// Steps for the transient of a winding come first and grow with it; what is left is divided evenly.
class Division {
 public:
  Division() = default;

  /// Of h, for effects of which the fastest has the rate `effects` [1/s].
  Division(double h, double effects) { ask(steps_over(effects * h)); }

  /// Of h, for the fastest effect and the transient of a winding, which is between once and 2^level times as fast as
  /// `rate`, its R/L.
  Division(double h, double effects, double rate, int level) {
    double length = angle_of_a_winding / (rate * resistances_of(level));
    const int most = std::min(2 + level, most_transients);
    for (; transients_ < most && h - gone_ > length && effects * length <= angle_of_a_step;
         ++transients_, length *= 2.0) {
      transient_[static_cast<std::size_t>(transients_)] = length;
      gone_ += length;
    }
    ask(steps_over(effects * (h - gone_)));
  }

  /// At least so many steps for what is left.
  void ask(double steps) { even_ = std::max(even_, static_cast<int>(std::ceil(steps))); }

  int count() const { return transients_ + even_; }

  /// The k-th length of an interval of length h.
  template <class S>
  S length(int k, const S& h) const {
    if (k < transients_) return S(transient_[static_cast<std::size_t>(k)]);
    return count() == 1 ? h : (h - gone_) / static_cast<double>(even_);
  }

 private:
  /// Steps over an angle (rate times time) of an effect: up to `most_exact` for accuracy, more for stability alone.
  static double steps_over(double angle) {
    return std::max(std::min(angle / angle_of_a_step, most_exact), std::min(angle / stable_angle, most_stable));
  }

  static constexpr double angle_of_a_step = 0.7;
  // Half of the 2.78 that a fourth-order Runge-Kutta step is stable over: a bristle bent against the motion is twice as
  // fast as the rate that its effect states.
  static constexpr double stable_angle = 1.39;
  static constexpr double most_exact = 16.0;
  static constexpr double most_stable = 1024.0;  // a bound on what one row may cost while parameters are tried
  static constexpr int most_transients = 6;  // of a winding 16 times as fast as R/L
  std::array<double, most_transients> transient_{};
  double gone_ = 0.0;
  int transients_ = 0, even_ = 1;
};

}  // namespace rwn
