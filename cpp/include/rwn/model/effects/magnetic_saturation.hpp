#pragma once

#include "rwn/model/effect.hpp"

namespace rwn {

struct MagneticSaturation {
  static constexpr EffectInfo info{"magnetic-saturation", Site::flux, "Kt, Ke, L divided by 1 + (i/i_s)^2",
                                   "flux and inductance that fall at high current (armature reaction, iron)",
                                   "Krause, Analysis of Electric Machinery"};
  static constexpr std::array parameters{Parameter{.name = "saturation_current",
                                                   .symbol = "i_s",
                                                   .unit = "A",
                                                   .meaning = "current that halves the flux",
                                                   .lower = 0.3,
                                                   .upper = 100.0,
                                                   .start = 3.0,
                                                   .scale = scale::current,
                                                   .scan = {1.5, 5.0},
                                                   .strength = true}};
  static constexpr EffectTraits traits{.hooks = Hook::apply};

  template <class S>
  static void apply(const S* p, const Motor<S>&, const Motion<S>& x, Terms<S>& t) {
    const S ratio = x.current / p[0];
    const S factor = 1.0 / (1.0 + ratio * ratio);
    t.flux *= factor;
    t.inductance *= factor;
  }
};

}  // namespace rwn
