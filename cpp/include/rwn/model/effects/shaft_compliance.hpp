#pragma once

#include "rwn/model/effect.hpp"

namespace rwn {

struct ShaftCompliance {
  static constexpr EffectInfo info{"shaft-compliance", Site::load,
                                   "T_shaft = k (theta - theta_L) + c (w - w_L); J_L dw_L/dt = T_shaft - s B w_L",
                                   "a shaft or coupling that twists between motor and load (two masses)",
                                   "Schroeder, Elektrische Antriebe; thesis ref. 25"};
  static constexpr std::array parameters{Parameter{.name = "stiffness",
                                                   .symbol = "k",
                                                   .unit = "N m/rad",
                                                   .meaning = "torque per twist",
                                                   .lower = 1e-5,
                                                   .upper = 1e4,
                                                   .start = 1.0,
                                                   .scale = scale::stiffness,
                                                   .scan = {3e-4, 1e-3, 4e-3, 0.015, 0.05, 0.15, 0.5, 2.0, 8.0},
                                                   .strength = true},
                                         Parameter{.name = "damping",
                                                   .symbol = "c",
                                                   .unit = "N m s/rad",
                                                   .meaning = "torque per rate of twist",
                                                   .lower = 0.0,
                                                   .upper = 100.0,
                                                   .start = 0.1,
                                                   .scale = scale::damping},
                                         Parameter{.name = "load_inertia",
                                                   .symbol = "J_L",
                                                   .unit = "kg m^2",
                                                   .meaning = "part of the inertia that is behind it",
                                                   .lower = 0.02,
                                                   .upper = 0.95,
                                                   .start = 0.4,
                                                   .scale = scale::inertia,
                                                   .scan = {0.25, 0.6}},
                                         load_viscous_share};
  static constexpr EffectTraits traits{.hooks = Hook::joint};

  template <class S>
  static Joint<S> joint(const S* p, const Motor<S>& m) {
    return {.stiffness = p[0], .damping = p[1], .inertia_behind = p[2], .viscous_behind = p[3] * m[viscous_friction]};
  }
};

}  // namespace rwn
