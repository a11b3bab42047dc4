#pragma once

#include "rwn/model/effect.hpp"

namespace rwn {

struct ViscousFriction {
  static constexpr EffectInfo info{"viscous-friction", Site::torque, "T = -b w",
                                   "friction torque proportional to speed, beside the nominal one",
                                   "Newton; B. Armstrong-Helouvry, Control of Machines with Friction, 1991"};
  static constexpr std::array parameters{Parameter{.name = "damping",
                                                   .symbol = "b",
                                                   .unit = "N m s/rad",
                                                   .meaning = "torque per speed",
                                                   .lower = 0.0,
                                                   .upper = 1e3,
                                                   .start = 0.1,
                                                   .scale = scale::damping,
                                                   .strength = true,
                                                   .beside = viscous_friction}};
  static constexpr EffectTraits traits{.hooks = Hook::apply};

  template <class S>
  static void apply(const S* p, const Motor<S>&, const Motion<S>& x, Terms<S>& t) {
    t.torque -= p[0] * x.speed;
  }
};

}  // namespace rwn
