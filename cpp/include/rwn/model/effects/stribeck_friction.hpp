#pragma once

#include "rwn/model/effect.hpp"

namespace rwn {

struct StribeckFriction {
  static constexpr EffectInfo info{"stribeck-friction", Site::torque,
                                   "T = -(T_c + (T_s - T_c) exp(-(w/w_s)^2)) sign(w), holds up to T_s at standstill",
                                   "dry friction that is higher near standstill",
                                   "R. Stribeck 1902; thesis eq. 3.99; B. Armstrong-Helouvry 1991"};
  static constexpr std::array parameters{Parameter{.name = "coulomb_torque",
                                                   .symbol = "T_c",
                                                   .unit = "N m",
                                                   .meaning = "level when sliding fast",
                                                   .lower = 0.0,
                                                   .upper = 1.0,
                                                   .start = 0.05,
                                                   .scale = scale::torque,
                                                   .replaces = coulomb_friction},
                                         Parameter{.name = "static_torque",
                                                   .symbol = "T_s",
                                                   .unit = "N m",
                                                   .meaning = "level at standstill",
                                                   .lower = 0.0,
                                                   .upper = 1.0,
                                                   .start = 0.08,
                                                   .scale = scale::torque, .scan = {0.06, 0.08},
                                                   .strength = true},
                                         Parameter{.name = "stribeck_speed",
                                                   .symbol = "w_s",
                                                   .unit = "rad/s",
                                                   .meaning = "speed over which the level falls",
                                                   .lower = 1e-3,
                                                   .upper = 0.5,
                                                   .start = 0.03,
                                                   .scale = scale::speed,
                                                   .scan = {0.015, 0.05, 0.15}}};
  static constexpr EffectTraits traits{.hooks = Hook::apply | Hook::rate, .dry = true, .holds = true};

  template <class S>
  static void apply(const S* p, const Motor<S>&, const Motion<S>& x, Terms<S>& t) {
    using std::exp;
    const S ratio = x.speed / p[2];
    t.friction += p[0];
    if (value_of(p[1]) > value_of(p[0])) t.friction += (p[1] - p[0]) * exp(-(ratio * ratio));
  }
  template <class S>
  static double rate(const S* p, const Motor<S>&, const Motion<S>& x, double acceleration, double) {
    return std::abs(value_of(x.speed)) < 4.0 * value_of(p[2]) ? acceleration / value_of(p[2]) : 0.0;
  }
};

}  // namespace rwn
