#pragma once

#include "rwn/model/effect.hpp"

namespace rwn {

struct AsymmetricFriction {
  static constexpr EffectInfo info{"asymmetric-friction", Site::torque, "T = -T_c+ (w > 0), +T_c- (w < 0)",
                                   "dry friction of another level in each direction, or of one beside a steady load",
                                   "B. Armstrong-Helouvry 1991; Janot, Gautier, Brunot 2019 (EMPS)"};
  static constexpr std::array parameters{Parameter{.name = "coulomb_torque_plus",
                                                   .symbol = "T_c+",
                                                   .unit = "N m",
                                                   .meaning = "level for w > 0",
                                                   .lower = 0.0,
                                                   .upper = 1.0,
                                                   .start = 0.06,
                                                   .scale = scale::torque,
                                                   .strength = true,
                                                   .replaces = coulomb_friction},
                                         Parameter{.name = "coulomb_torque_minus",
                                                   .symbol = "T_c-",
                                                   .unit = "N m",
                                                   .meaning = "level for w < 0",
                                                   .lower = 0.0,
                                                   .upper = 1.0,
                                                   .start = 0.04,
                                                   .scale = scale::torque,
                                                   .strength = true,
                                                   .replaces = coulomb_friction}};
  static constexpr EffectTraits traits{.hooks = Hook::apply, .varies = false, .dry = true, .one_sided = true};

  template <class S>
  static void apply(const S* p, const Motor<S>&, const Motion<S>& x, Terms<S>& t) {
    t.friction += x.direction > 0.0 ? p[0] : p[1];
  }
};

}  // namespace rwn
