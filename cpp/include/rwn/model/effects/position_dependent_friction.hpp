#pragma once

#include "rwn/model/effect.hpp"
#include "rwn/model/periodic.hpp"

namespace rwn {

struct PositionDependentFriction {
  static constexpr EffectInfo info{
      "position-dependent-friction", Site::torque, "T = -T_c (1 + a cos(theta + p)) sign(w)",
      "dry friction that varies over the revolution (bent shaft, worn bearing)", "B. Armstrong-Helouvry 1991, ch. 4"};
  static constexpr std::array parameters{Parameter{.name = "coulomb_torque",
                                                   .symbol = "T_c",
                                                   .unit = "N m",
                                                   .meaning = "mean friction level",
                                                   .lower = 0.0,
                                                   .upper = 1.0,
                                                   .start = 0.05,
                                                   .scale = scale::torque,
                                                   .replaces = coulomb_friction},
                                         Parameter{.name = "variation",
                                                   .symbol = "a",
                                                   .unit = "1",
                                                   .meaning = "relative variation a",
                                                   .lower = 0.0,
                                                   .upper = 1.0,
                                                   .start = 0.3,
                                                   .strength = true},
                                         periodic::phase};
  static constexpr EffectTraits traits{.hooks = Hook::apply | Hook::rate,
                                       .dry = true,
                                       .turns = true,
                                       .one_sided = true};

  template <class S>
  static void apply(const S* p, const Motor<S>&, const Motion<S>& x, Terms<S>& t) {
    using std::cos;
    t.friction += p[0] * (1.0 + p[1] * cos(x.angle + p[2]));
  }
  template <class S>
  static double rate(const S*, const Motor<S>&, const Motion<S>& x, double, double) {
    return std::abs(value_of(x.speed)) * x.angle_per_position;
  }
};

}  // namespace rwn
