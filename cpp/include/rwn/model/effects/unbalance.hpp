#pragma once

#include "rwn/model/effect.hpp"
#include "rwn/model/periodic.hpp"

namespace rwn {

struct Unbalance {
  static constexpr EffectInfo info{"unbalance", Site::torque, "T = -A sin(theta + p)",
                                   "an off-centre mass in gravity: one period per revolution", "Newton"};
  static constexpr std::array parameters{periodic::peak_torque, periodic::phase};
  static constexpr EffectTraits traits{.hooks = Hook::apply | Hook::rate, .turns = true, .one_sided = true};

  template <class S>
  static void apply(const S* p, const Motor<S>&, const Motion<S>& x, Terms<S>& t) {
    using std::sin;
    t.torque -= p[0] * sin(x.angle + p[1]);
  }
  template <class S>
  static double rate(const S*, const Motor<S>&, const Motion<S>& x, double, double) {
    return std::abs(value_of(x.speed)) * x.angle_per_position;
  }
};

}  // namespace rwn
