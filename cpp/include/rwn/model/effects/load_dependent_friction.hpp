#pragma once

#include "rwn/model/effect.hpp"
#include "rwn/model/transmitted_torque.hpp"

namespace rwn {

struct LoadDependentFriction {
  static constexpr EffectInfo info{
      "load-dependent-friction", Site::torque, "T = -mu |Kt i + m g l sin(theta)| sign(w)",
      "dry friction that grows with the transmitted torque, a known pendulum's included (gears)",
      "Rhoban BAM, models M3-M6; P. Hamon et al. 2010"};
  static constexpr std::array parameters{Parameter{.name = "friction_ratio",
                                                   .symbol = "mu",
                                                   .unit = "1",
                                                   .meaning = "friction torque per transmitted torque",
                                                   .lower = 0.0,
                                                   .upper = 0.9,
                                                   .start = 0.1,
                                                   .strength = true}};
  static constexpr EffectTraits traits{.hooks = Hook::apply, .dry = true, .loaded = true};

  template <class S>
  static void apply(const S* p, const Motor<S>& motor, const Motion<S>& x, Terms<S>& t) {
    using std::abs;
    t.friction += p[0] * abs(transmitted_torque(motor, x));
  }
};

}  // namespace rwn
