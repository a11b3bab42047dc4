#pragma once

#include "rwn/model/effect.hpp"

namespace rwn {

struct ConstantLoad {
  static constexpr EffectInfo info{"constant-load", Site::load, "T = -T_l",
                                   "a steady load torque, or an offset of the drive",
                                   "Janot, Gautier, Brunot 2019 (EMPS)"};
  static constexpr std::array parameters{Parameter{.name = "torque",
                                                   .symbol = "T_l",
                                                   .unit = "N m",
                                                   .meaning = "brakes positive rotation",
                                                   .lower = -1.0,
                                                   .upper = 1.0,
                                                   .start = 0.01,
                                                   .scale = scale::torque,
                                                   .strength = true}};
  static constexpr EffectTraits traits{.hooks = Hook::apply, .varies = false, .one_sided = true};

  template <class S>
  static void apply(const S* p, const Motor<S>&, const Motion<S>&, Terms<S>& t) {
    t.torque -= p[0];
  }
};

}  // namespace rwn
