#pragma once

#include "rwn/model/effect.hpp"
#include "rwn/model/periodic.hpp"

namespace rwn {

struct GearedUnbalance {
  static constexpr EffectInfo info{"geared-unbalance", Site::torque, "T = -A sin(N theta + p), N < 1",
                                   "an off-centre mass or wheel on a shaft that a gear makes slower",
                                   "Newton; Smith, Gear Noise and Vibration, 2003 (run-out)"};
  static constexpr std::array parameters{periodic::peak_torque, periodic::slow_order, periodic::phase};
  static constexpr EffectTraits traits{
      .hooks = Hook::apply | Hook::rate, .turns = true, .one_sided = true, .guess = Guess::spectrum};

  template <class S>
  static void apply(const S* p, const Motor<S>&, const Motion<S>& x, Terms<S>& t) {
    using std::sin;
    t.torque -= p[0] * sin(p[1] * x.angle + p[2]);
  }
  template <class S>
  static double rate(const S* p, const Motor<S>&, const Motion<S>& x, double, double) {
    return value_of(p[1]) * std::abs(value_of(x.speed)) * x.angle_per_position;
  }
};

}  // namespace rwn
