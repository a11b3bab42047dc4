#pragma once

#include <cmath>

#include "rwn/model/effect.hpp"

namespace rwn {

struct LoadSpring {
  static constexpr EffectInfo info{"load-spring", Site::load, "T = -T_0 - k theta",
                                   "a torque that grows with the position: a return spring, a cable, a hose", "Hooke"};
  static constexpr std::array parameters{Parameter{.name = "stiffness",
                                                   .symbol = "k",
                                                   .unit = "N m/rad",
                                                   .meaning = "of the spring",
                                                   .lower = 0.0,
                                                   .upper = 1e4,
                                                   .start = 1.0,
                                                   .scale = scale::torque / (scale::speed * scale::duration),
                                                   .scan = {0.3, 10.0},
                                                   .strength = true},
                                         Parameter{.name = "preload",
                                                   .symbol = "T_0",
                                                   .unit = "N m",
                                                   .meaning = "its torque at position 0",
                                                   .lower = -1.0,
                                                   .upper = 1.0,
                                                   .start = 0.01,
                                                   .scale = scale::torque}};
  static constexpr EffectTraits traits{.hooks = Hook::apply | Hook::rate, .special_case = "constant-load"};

  template <class S>
  static void apply(const S* p, const Motor<S>&, const Motion<S>& x, Terms<S>& t) {
    t.torque -= p[1] + p[0] * x.position;
  }
  /// It swings on the spring.
  template <class S>
  static double rate(const S* p, const Motor<S>& m, const Motion<S>&, double, double) {
    return std::sqrt(value_of(p[0]) / value_of(m[inertia]));
  }
  static void specialise(const double* p, double* load) { load[0] = p[1]; }
};

}  // namespace rwn
