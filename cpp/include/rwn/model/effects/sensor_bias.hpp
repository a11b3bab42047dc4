#pragma once

#include "rwn/model/effect.hpp"

namespace rwn {

struct SensorBias {
  static constexpr EffectInfo info{"sensor-bias", Site::sensor, "y_w = w + b_w, y_i = i + b_i",
                                   "a constant offset of the speed or the current signal", "standard"};
  static constexpr std::array parameters{Parameter{.name = "speed_offset",
                                                   .symbol = "b_w",
                                                   .unit = "rad/s",
                                                   .meaning = "added to the true speed",
                                                   .lower = -0.5,
                                                   .upper = 0.5,
                                                   .start = 0.0,
                                                   .scale = scale::speed,
                                                   .strength = true},
                                         Parameter{.name = "current_offset",
                                                   .symbol = "b_i",
                                                   .unit = "A",
                                                   .meaning = "added to the true current",
                                                   .lower = -0.5,
                                                   .upper = 0.5,
                                                   .start = 0.0,
                                                   .scale = scale::current,
                                                   .strength = true}};
  static constexpr EffectTraits traits{.hooks = Hook::sense, .one_sided = true};

  template <class S>
  static void sense(const S* p, Reading<S>& y, const S*) {
    y.speed += p[0];
    y.current += p[1];
  }
};

}  // namespace rwn
