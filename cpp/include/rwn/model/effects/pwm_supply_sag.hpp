#pragma once

#include "rwn/model/effect.hpp"

namespace rwn {

struct PwmSupplySag {
  static constexpr EffectInfo info{"pwm-supply-sag", Site::voltage, "v = u - k u^2 i, k = R_s / V_0^2",
                                   "a bridge passes the sag of its supply on, by the square of its duty u / V_0: a "
                                   "battery, behind a drive that does not measure it",
                                   "mean of a switched converter: N. Mohan et al., Power Electronics"};
  static constexpr std::array parameters{
      Parameter{.name = "sag",
                .symbol = "k",
                .unit = "1/(V A)",
                .meaning = "resistance of supply and cables over the square of the supply's voltage",
                .lower = 0.0,
                .upper = 2.0,
                .start = 0.15,
                .scale = scale::none / (scale::voltage * scale::current),
                .scan = {0.05, 0.4},
                .strength = true}};
  static constexpr EffectTraits traits{.hooks = Hook::apply};

  template <class S>
  static void apply(const S* p, const Motor<S>&, const Motion<S>& x, Terms<S>& t) {
    t.resistance += p[0] * x.input * x.input / x.winding->resistance;
  }
};

}  // namespace rwn
