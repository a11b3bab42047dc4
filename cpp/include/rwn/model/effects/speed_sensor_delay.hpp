#pragma once

#include "rwn/model/effect.hpp"

namespace rwn {

struct SpeedSensorDelay {
  static constexpr EffectInfo info{"speed-sensor-delay", Site::sensor, "y(t) = w(t - d)",
                                   "speed and position are shown late against the current", "standard"};
  static constexpr std::array parameters{Parameter{.name = "delay",
                                                   .symbol = "d",
                                                   .unit = "s",
                                                   .meaning = "need not be a whole number of samples",
                                                   .lower = 0.0,
                                                   .upper = 40.0,
                                                   .start = 0.8,
                                                   .scale = scale::time_step,
                                                   .scan = {0.3, 0.8, 1.4, 2.3, 3.6, 5.5, 8.0, 12.0, 18.0, 27.0},
                                                   .strength = true}};
  static constexpr EffectTraits traits{.hooks = Hook::late, .varies = false, .shows_late = "speed"};

  template <class S>
  static S late(const S* p) {
    return p[0];
  }
};

}  // namespace rwn
