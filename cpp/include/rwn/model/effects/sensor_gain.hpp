#pragma once

#include "rwn/model/effect.hpp"

namespace rwn {

struct SensorGain {
  static constexpr EffectInfo info{"sensor-gain", Site::sensor, "y_w = g_w w, y_i = g_i i",
                                   "the scale of the speed or the current sensor, as its data sheet has it",
                                   "standard"};
  static constexpr std::array parameters{Parameter{.name = "speed_gain",
                                                   .symbol = "g_w",
                                                   .unit = "1",
                                                   .meaning = "speed shown over the true speed",
                                                   .lower = 0.5,
                                                   .upper = 2.0,
                                                   .start = 1.0},
                                         Parameter{.name = "current_gain",
                                                   .symbol = "g_i",
                                                   .unit = "1",
                                                   .meaning = "current shown over the true current",
                                                   .lower = 0.5,
                                                   .upper = 2.0,
                                                   .start = 1.0}};
  /// Never sought, as the parameters of the motor stand for a scale nearly as well: it acts where a model declares it.
  static constexpr EffectTraits traits{.hooks = Hook::sense, .guess = Guess::none};

  template <class S>
  static void sense(const S* p, Reading<S>& y, const S*) {
    y.speed *= p[0];
    y.current *= p[1];
  }
};

}  // namespace rwn
