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
  static constexpr EffectTraits traits{.hooks = Hook::apply | Hook::rate, .special_case = "quadratic-drag"};
  static constexpr double viscous_below = 0.01;  // of the reference speed, so that its slope is finite

  template <class S>
  static void apply(const S* p, const Motor<S>&, const Motion<S>& x, Terms<S>& t) {
    using std::pow;
    const S ratio = x.speed / p[2];
    t.torque -= p[0] * ratio * pow(ratio * ratio + viscous_below * viscous_below, 0.5 * (p[1] - 1.0));
  }
  static void specialise(const double* p, double* quadratic) { quadratic[0] = p[0] / (p[2] * p[2]); }
  /// By its steepest slope over the speeds of the next h: at the lowest of them below the first power, else the
  /// highest.
  template <class S>
  static double rate(const S* p, const Motor<S>& m, const Motion<S>& x, double acceleration, double h) {
    const double n = value_of(p[1]), w = std::abs(value_of(x.speed)), change = acceleration * h;
    const double ratio = (n < 1.0 ? std::max(w - change, 0.0) : w + change) / value_of(p[2]);
    const double slope = std::max(n, 1.0) * std::pow(ratio * ratio + viscous_below * viscous_below, 0.5 * (n - 1.0));
    return value_of(p[0]) * slope / (value_of(p[2]) * value_of(m[inertia]));
  }
};

}  // namespace rwn
