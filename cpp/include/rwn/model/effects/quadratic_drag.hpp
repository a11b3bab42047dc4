#pragma once

#include "rwn/model/effect.hpp"

namespace rwn {

struct QuadraticDrag {
  static constexpr EffectInfo info{"quadratic-drag", Site::torque, "T = -k w |w|",
                                   "air or fluid drag of a fan, rotor or pump", "Lord Rayleigh 1876"};
  static constexpr std::array parameters{Parameter{.name = "drag_coefficient",
                                                   .symbol = "k",
                                                   .unit = "N m s^2/rad^2",
                                                   .meaning = "torque per squared speed",
                                                   .lower = 0.0,
                                                   .upper = 2.0,
                                                   .start = 0.1,
                                                   .scale = scale::torque / (scale::speed * scale::speed),
                                                   .strength = true}};
  static constexpr EffectTraits traits{.hooks = Hook::apply};

  template <class S>
  static void apply(const S* p, const Motor<S>&, const Motion<S>& x, Terms<S>& t) {
    using std::abs;
    t.torque -= p[0] * x.speed * abs(x.speed);
  }
};

}  // namespace rwn
