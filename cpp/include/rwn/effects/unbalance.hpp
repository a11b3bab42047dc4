#pragma once

#include "rwn/effect.hpp"

namespace rwn {

struct Unbalance {
  static constexpr EffectInfo info{"unbalance", Site::torque, "T = -A sin(theta + p)",
                                   "an off-centre mass in gravity: one period per revolution", "Newton"};
  static constexpr std::array parameters{Parameter{.name = "amplitude",
                                                   .unit = "N m",
                                                   .meaning = "peak torque",
                                                   .lower = 0.0,
                                                   .upper = 1.0,
                                                   .start = 0.03,
                                                   .scale = Scale::torque,
                                                   .strength = true},
                                         Parameter{.name = "phase",
                                                   .unit = "rad",
                                                   .meaning = "at position 0",
                                                   .lower = -6.4,
                                                   .upper = 6.4,
                                                   .start = 0.0,
                                                   .scan = {0.0, 1.5707963, 3.1415927, -1.5707963},
                                                   .cyclic = true}};
  static constexpr bool turns = true;

  template <class S>
  static void apply(const S* p, const Motor<S>&, const Motion<S>& x, Terms<S>& t) {
    using std::sin;
    t.torque -= p[0] * sin(x.angle + p[1]);
  }
  template <class S>
  static double rate(const S*, const Motor<S>&, const Motion<S>& x, double) {
    return std::abs(value_of(x.speed)) * x.angle_per_position;
  }
};

}  // namespace rwn
