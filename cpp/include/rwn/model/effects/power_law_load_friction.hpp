#pragma once

#include <cmath>

#include "rwn/model/effect.hpp"
#include "rwn/model/transmitted_torque.hpp"

namespace rwn {

struct PowerLawLoadFriction {
  static constexpr EffectInfo info{"power-law-load-friction", Site::torque,
                                   "T = -T_l |(Kt i + m g l sin(theta)) / T_r|^n sign(w)",
                                   "dry friction by a power of the transmitted torque: gears, iron losses (1.6 to 2)",
                                   "Rhoban BAM, model M6; C. P. Steinmetz 1892"};
  static constexpr std::array parameters{Parameter{.name = "friction_torque",
                                                   .symbol = "T_l",
                                                   .unit = "N m",
                                                   .meaning = "friction torque at the reference torque",
                                                   .lower = 0.0,
                                                   .upper = 0.9,
                                                   .start = 0.1,
                                                   .scale = scale::torque,
                                                   .strength = true},
                                         Parameter{.name = "exponent",
                                                   .symbol = "n",
                                                   .unit = "1",
                                                   .meaning = "power of the transmitted torque; 1 is in proportion",
                                                   .lower = 0.3,
                                                   .upper = 4.0,
                                                   .start = 2.0,
                                                   .scan = {0.5, 2.0}},
                                         Parameter{.name = "reference_torque",
                                                   .symbol = "T_r",
                                                   .unit = "N m",
                                                   .meaning = "transmitted torque at which it is stated; a choice",
                                                   .lower = 0.0,
                                                   .upper = 10.0,
                                                   .start = 1.0,
                                                   .scale = scale::torque,
                                                   .fixed = true}};
  static constexpr EffectTraits traits{
      .hooks = Hook::apply, .dry = true, .loaded = true, .special_case = "load-dependent-friction"};
  static constexpr double smooth_below = 0.01;  // of the reference torque, so that its slope is finite

  template <class S>
  static void apply(const S* p, const Motor<S>& motor, const Motion<S>& x, Terms<S>& t) {
    using std::pow;
    const S ratio = transmitted_torque(motor, x) / p[2];
    t.friction += p[0] * pow(ratio * ratio + smooth_below * smooth_below, 0.5 * p[1]);
  }
  static void specialise(const double* p, double* plain) { plain[0] = p[0] / p[2]; }
};

}  // namespace rwn
