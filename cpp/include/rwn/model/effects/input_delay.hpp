#pragma once

#include "rwn/model/effect.hpp"

namespace rwn {

struct InputDelay {
  static constexpr EffectInfo info{"input-delay", Site::actuator, "v(t) = u(t - d)",
                                   "the command acts late (sampling, bus, amplifier)", "standard"};
  static constexpr std::array parameters{Parameter{.name = "delay",
                                                   .symbol = "d",
                                                   .unit = "s",
                                                   .meaning = "need not be a whole number of samples",
                                                   .lower = 0.0,
                                                   .upper = 500.0,
                                                   .start = 1.3,
                                                   .scale = scale::time_step,
                                                   .scan = {0.2,  0.4,  0.6,  0.85, 1.15, 1.5,  1.85, 2.2,
                                                            2.5,  2.85, 3.3,  3.7,  4.5,  5.5,  6.5,  8.0,
                                                            10.0, 13.0, 17.0, 23.0, 32.0, 50.0, 80.0, 120.0},
                                                   .strength = true}};
  static constexpr EffectTraits traits{.hooks = Hook::delay, .varies = false};

  template <class S>
  static S delay(const S* p) {
    return p[0];
  }
};

}  // namespace rwn
