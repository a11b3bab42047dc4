#pragma once

#include "rwn/model/effect.hpp"

namespace rwn {

struct SensorQuantization {
  static constexpr EffectInfo info{"sensor-quantization", Site::sensor, "y = q round(w / q)",
                                   "the speed signal comes in steps", "Widrow, Kollar 2008"};
  static constexpr std::array parameters{Parameter{.name = "resolution",
                                                   .symbol = "q",
                                                   .unit = "rad/s",
                                                   .meaning = "step of the speed signal",
                                                   .lower = 0.0,
                                                   .upper = 0.5,
                                                   .start = 0.01,
                                                   .scale = scale::speed,
                                                   .strength = true}};
  /// Never sought: its step is read off the recorded values.
  static constexpr EffectTraits traits{.hooks = Hook::sense, .guess = Guess::none};

  template <class S>
  static void sense(const S* p, Reading<S>& y, const S*) {
    const double step = value_of(p[0]);
    if (step > 0.0) y.speed += step * std::round(value_of(y.speed) / step) - value_of(y.speed);
  }
};

}  // namespace rwn
