#pragma once

#include "rwn/model/effect.hpp"

namespace rwn {

struct ViscousAsymmetry {
  static constexpr EffectInfo info{"viscous-asymmetry", Site::torque, "T = -d |w|",
                                   "viscous friction differs between the directions: B + d and B - d",
                                   "Janot, Gautier, Brunot 2019 (EMPS)"};
  static constexpr std::array parameters{Parameter{.name = "difference",
                                                   .symbol = "d",
                                                   .unit = "N m s/rad",
                                                   .meaning = "half the difference of the two directions",
                                                   .lower = -1.0,
                                                   .upper = 1.0,
                                                   .start = 0.02,
                                                   .scale = scale::damping,
                                                   .scan = {0.02, -0.02},
                                                   .strength = true}};
  static constexpr EffectTraits traits{.hooks = Hook::apply, .one_sided = true};

  template <class S>
  static void apply(const S* p, const Motor<S>&, const Motion<S>& x, Terms<S>& t) {
    using std::abs;
    t.torque -= p[0] * abs(x.speed);
  }
};

}  // namespace rwn
