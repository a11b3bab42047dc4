#pragma once

#include "rwn/model/effect.hpp"

namespace rwn {

struct InertiaVariation {
  static constexpr EffectInfo info{"inertia-variation", Site::load, "J(theta) = J + J_2 cos(2 theta)",
                                   "inertia that varies with angle (crank, linkage, eccentric load)",
                                   "Lagrange: (J + J2) dw/dt + w^2 J2'/2 = T"};
  static constexpr std::array parameters{Parameter{.name = "amplitude",
                                                   .symbol = "J_2",
                                                   .unit = "kg m^2",
                                                   .meaning = "peak of the varying part",
                                                   .lower = -0.9,
                                                   .upper = 0.9,
                                                   .start = 0.1,
                                                   .scale = scale::inertia,
                                                   .strength = true}};
  static constexpr EffectTraits traits{.hooks = Hook::apply | Hook::rate, .turns = true, .inertial = true};

  template <class S>
  static void apply(const S* p, const Motor<S>&, const Motion<S>& x, Terms<S>& t) {
    using std::cos;
    using std::sin;
    t.inertia += p[0] * cos(2.0 * x.angle);
    t.inertia_slope -= 2.0 * x.angle_per_position * p[0] * sin(2.0 * x.angle);
  }
  template <class S>
  static double rate(const S*, const Motor<S>&, const Motion<S>& x, double, double) {
    return 2.0 * std::abs(value_of(x.speed)) * x.angle_per_position;
  }
};

}  // namespace rwn
