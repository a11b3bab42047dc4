#pragma once

#include "rwn/model/effect.hpp"

namespace rwn {

struct CoastingBridge {
  static constexpr EffectInfo info{"coasting-bridge", Site::voltage, "v = u + s (1 - |u| / V_s) Ke w",
                                   "the winding is open between the pulses of the bridge (fast decay): the back-EMF "
                                   "acts for the share of the duty only",
                                   "mean of discontinuous conduction: N. Mohan et al., Power Electronics"};
  static constexpr std::array parameters{Parameter{.name = "share",
                                                   .symbol = "s",
                                                   .unit = "1",
                                                   .meaning = "of the time between pulses in which the winding is open",
                                                   .lower = 0.0,
                                                   .upper = 1.0,
                                                   .start = 0.8,
                                                   .strength = true,
                                                   .natural = true},
                                         Parameter{.name = "supply",
                                                   .symbol = "V_s",
                                                   .unit = "V",
                                                   .meaning = "voltage of the pulses: the command of full duty",
                                                   .lower = 0.5,
                                                   .upper = 20.0,
                                                   .start = 1.2,
                                                   .scale = scale::voltage,
                                                   .scan = {2.5}}};
  static constexpr EffectTraits traits{.hooks = Hook::apply | Hook::rate};

  template <class S>
  static void apply(const S* p, const Motor<S>&, const Motion<S>& x, Terms<S>& t) {
    using std::abs;
    const S off = 1.0 - abs(x.input) / p[1];  // share of a period without a pulse
    if (value_of(off) > 0.0) t.drop -= p[0] * off * x.winding->back_emf_constant * x.speed;
  }
  /// It takes a part of the back-EMF out of the equations, and of its damping.
  template <class S>
  static double rate(const S* p, const Motor<S>& m, const Motion<S>& x, double, double) {
    const double off = 1.0 - std::abs(value_of(x.input)) / value_of(p[1]);
    return off > 0.0 ? value_of(p[0]) * off * x.winding->braking_rate(value_of(m[inertia])) : 0.0;
  }
};

}  // namespace rwn
