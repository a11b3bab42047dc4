#pragma once

#include "rwn/model/effect.hpp"
#include "rwn/model/periodic.hpp"

namespace rwn {

struct CoggingTorque {
  static constexpr EffectInfo info{"cogging-torque", Site::torque, "T = -A sin(N theta + p)",
                                   "torque of the magnets on the slots, or a position-periodic force",
                                   "Gieras, Permanent Magnet Motor Technology, ch. 6"};
  static constexpr std::array parameters{periodic::any_peak_torque,
                                         Parameter{.name = "periods_per_rev",
                                                   .symbol = "N",
                                                   .unit = "1",
                                                   .meaning = "periods per revolution (per metre on a linear axis)",
                                                   .lower = 1.5,
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
    using std::sin;
    t.torque -= p[0] * sin(p[1] * x.angle + p[2]);
  }
  template <class S>
  static double rate(const S* p, const Motor<S>&, const Motion<S>& x, double, double) {
    // 1.3 rad of a period a step: the error of its quadrature, (1.3)^4 / 2880, is 0.1 % of the ripple
    return 0.55 * value_of(p[1]) * std::abs(value_of(x.speed)) * x.angle_per_position;
  }
};

}  // namespace rwn
