#pragma once

#include "rwn/model/effect.hpp"
#include "rwn/model/periodic.hpp"

namespace rwn {

struct TorqueRipple {
  static constexpr EffectInfo info{"torque-ripple", Site::flux, "Kt, Ke times 1 + a cos(N theta + p)",
                                   "torque constant that varies with angle (commutation, few segments)",
                                   "Jahns, Soong 1996"};
  static constexpr std::array parameters{Parameter{.name = "amplitude",
                                                   .symbol = "a",
                                                   .unit = "1",
                                                   .meaning = "relative variation",
                                                   .lower = 0.0,
                                                   .upper = 0.9,
                                                   .start = 0.05,
                                                   .strength = true},
                                         Parameter{.name = "harmonic",
                                                   .symbol = "N",
                                                   .unit = "1",
                                                   .meaning = "periods per revolution",
                                                   .lower = 0.5,
                                                   .upper = 1000.0,
                                                   .start = 12.0,
                                                   .order = true},
                                         periodic::phase};
  static constexpr EffectTraits traits{.hooks = Hook::apply | Hook::rate,
                                       .turns = true,
                                       .one_sided = true,
                                       .guess = Guess::spectrum};

  template <class S>
  static void apply(const S* p, const Motor<S>&, const Motion<S>& x, Terms<S>& t) {
    using std::cos;
    t.flux *= 1.0 + p[0] * cos(p[1] * x.angle + p[2]);
  }
  template <class S>
  static double rate(const S* p, const Motor<S>&, const Motion<S>& x, double, double) {
    // 1.3 rad of a period a step: the error of its quadrature, (1.3)^4 / 2880, is 0.1 % of the ripple
    return 0.55 * value_of(p[1]) * std::abs(value_of(x.speed)) * x.angle_per_position;
  }
};

}  // namespace rwn
