#pragma once

#include "rwn/effect.hpp"

namespace rwn {

struct LoadDependentFriction {
  static constexpr EffectInfo info{"load-dependent-friction", Site::torque, "T = -mu |Kt i| sign(w)",
                                   "dry friction that grows with the transmitted torque (gears, bearings)",
                                   "Rhoban BAM, models M4-M6; P. Hamon et al. 2010"};
  static constexpr std::array parameters{Parameter{.name = "friction_ratio",
                                                   .unit = "1",
                                                   .meaning = "friction torque per driving torque",
                                                   .lower = 0.0,
                                                   .upper = 0.9,
                                                   .start = 0.1,
                                                   .strength = true}};
  static constexpr bool dry = true;

  template <class S>
  static void apply(const S* p, const Motor<S>&, const Motion<S>& x, Terms<S>& t) {
    using std::abs;
    t.friction += p[0] * abs(x.drive_torque);
  }
};

}  // namespace rwn
