#pragma once

#include "rwn/effect.hpp"

namespace rwn {

struct InputDelay {
  static constexpr EffectInfo info{"input-delay", Site::actuator, "v(t) = u(t - d)",
                                   "the command acts late (sampling, bus, amplifier)", "standard"};
  static constexpr std::array parameters{Parameter{.name = "delay",
                                                   .unit = "s",
                                                   .meaning = "need not be a whole number of samples",
                                                   .lower = 0.0,
                                                   .upper = 500.0,
                                                   .start = 1.3,
                                                   .scale = Scale::time_step,
                                                   .scan = {0.4, 1.4, 3.5, 12.0, 40.0, 120.0},
                                                   .strength = true}};
  static constexpr bool varies = false;

  template <class S>
  static S delay(const S* p) {
    return p[0];
  }
};

}  // namespace rwn
