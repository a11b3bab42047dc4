#pragma once

#include "rwn/model/effect.hpp"

namespace rwn {

struct Backlash {
  static constexpr EffectInfo info{
      "backlash", Site::load,
      "T_shaft = k dead(theta - theta_L, gap) + c (w - w_L) in contact, never pulls; J_L dw_L/dt = T_shaft - s B w_L",
      "play between motor and load", "Nordin, Gutman 2002; contact: Brogliato 1999, ch. 2"};
  static constexpr std::array parameters{Parameter{.name = "gap",
                                                   .symbol = "gap",
                                                   .unit = "rad",
                                                   .meaning = "total play",
                                                   .lower = 2e-4,
                                                   .upper = 3.0,
                                                   .start = 0.05,
                                                   .scan = {0.01, 0.03, 0.1, 0.2, 0.3, 0.45, 0.65, 1.0}},
                                         Parameter{.name = "load_inertia",
                                                   .symbol = "J_L",
                                                   .unit = "kg m^2",
                                                   .meaning = "part of the inertia that is behind it",
                                                   .lower = 0.02,
                                                   .upper = 0.95,
                                                   .start = 0.4,
                                                   .scale = scale::inertia,
                                                   .scan = {0.2, 0.4, 0.6}},
                                         Parameter{.name = "contact_rate",
                                                   .unit = "rad/s",
                                                   .meaning = "natural frequency of the closed gap",
                                                   .lower = 600.0,
                                                   .upper = 5000.0,
                                                   .start = 1500.0,
                                                   .idealised = true},
                                         Parameter{.name = "contact_damping_ratio",
                                                   .unit = "1",
                                                   .meaning = "damping ratio of the closed gap: how little it rebounds",
                                                   .lower = 0.01,
                                                   .upper = 2.0,
                                                   .start = 0.4,
                                                   .idealised = true},
                                         load_viscous_share};
  static constexpr EffectTraits traits{.hooks = Hook::joint};

  template <class S>
  static Joint<S> joint(const S* p, const Motor<S>& m) {
    const S& load = p[1];
    const S reduced = load * (m[inertia] - load) / m[inertia];
    return {.stiffness = reduced * p[2] * p[2],
            .damping = 2.0 * p[3] * reduced * p[2],
            .inertia_behind = load,
            .viscous_behind = p[4] * m[viscous_friction],
            .half_gap = 0.5 * p[0],
            .play = true};
  }
};

}  // namespace rwn
