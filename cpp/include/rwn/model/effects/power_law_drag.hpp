#pragma once

#include <algorithm>
#include <cmath>

#include "rwn/model/effect.hpp"

namespace rwn {

struct PowerLawDrag {
  static constexpr EffectInfo info{"power-law-drag", Site::torque, "T = -T_d |w / w_r|^n sign(w)",
                                   "drag by a power of the speed: grease, magnets (n below 1), churning (above 2)",
                                   "W. Ostwald 1925; A. de Waele 1923"};
  static constexpr std::array parameters{Parameter{.name = "drag_torque",
                                                   .symbol = "T_d",
                                                   .unit = "N m",
                                                   .meaning = "torque at the reference speed",
                                                   .lower = 0.0,
                                                   .upper = 2.0,
                                                   .start = 0.1,
                                                   .scale = scale::torque,
                                                   .strength = true},
                                         Parameter{.name = "exponent",
                                                   .symbol = "n",
                                                   .unit = "1",
                                                   .meaning = "power of the speed; 0 is dry friction, 1 viscous",
                                                   .lower = 0.2,
                                                   .upper = 5.0,
                                                   .start = 3.0,
                                                   .scan = {0.5, 3.0}},
                                         Parameter{.name = "reference_speed",
                                                   .symbol = "w_r",
                                                   .unit = "rad/s",
                                                   .meaning = "speed at which the torque is stated; a choice",
                                                   .lower = 0.0,
                                                   .upper = 10.0,
                                                   .start = 1.0,
                                                   .scale = scale::speed,
                                                   .fixed = true}};
  static constexpr EffectTraits traits{.hooks = Hook::apply | Hook::rate};
  static constexpr double viscous_below = 0.01;  // of the reference speed, so that its slope is finite

  template <class S>
  static void apply(const S* p, const Motor<S>&, const Motion<S>& x, Terms<S>& t) {
    using std::pow;
    const S ratio = x.speed / p[2];
    t.torque -= p[0] * ratio * pow(ratio * ratio + viscous_below * viscous_below, 0.5 * (p[1] - 1.0));
  }
  /// How fast it brakes the motor by itself, or passes from viscous to its power.
  template <class S>
  static double rate(const S* p, const Motor<S>& m, const Motion<S>& x, double acceleration, double) {
    const double n = value_of(p[1]), w_r = value_of(p[2]), ratio = value_of(x.speed) / w_r;
    const double slope = std::pow(ratio * ratio + viscous_below * viscous_below, 0.5 * (n - 1.0));
    const double bends = std::abs(ratio) < 4.0 * viscous_below ? std::abs(acceleration) / (viscous_below * w_r) : 0.0;
    return std::max(n * value_of(p[0]) / w_r * slope / value_of(m[inertia]), bends);
  }
};

}  // namespace rwn
