#pragma once

#include "rwn/model/effect.hpp"

namespace rwn {

struct CoulombFriction {
  static constexpr EffectInfo info{"coulomb-friction", Site::torque, "T = -T_c sign(w), holds up to T_c at standstill",
                                   "dry friction of constant level", "C. A. Coulomb 1785; B. Armstrong-Helouvry 1991"};
  static constexpr std::array parameters{Parameter{.name = "coulomb_torque",
                                                   .symbol = "T_c",
                                                   .unit = "N m",
                                                   .meaning = "friction level",
                                                   .lower = 0.0,
                                                   .upper = 1.0,
                                                   .start = 0.05,
                                                   .scale = scale::torque,
                                                   .strength = true,
                                                   .replaces = coulomb_friction}};
  static constexpr EffectTraits traits{.hooks = Hook::apply, .varies = false, .dry = true, .holds = true};

  template <class S>
  static void apply(const S* p, const Motor<S>&, const Motion<S>&, Terms<S>& t) {
    t.friction += p[0];
  }
};

}  // namespace rwn
