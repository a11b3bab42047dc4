#pragma once

#include "rwn/model/effect.hpp"

namespace rwn {

struct SensorRectification {
  static constexpr EffectInfo info{"sensor-rectification", Site::sensor, "y = w_r |w / w_r|^e",
                                   "the speed sensor does not see the direction; with e > 1 it hardly sees slow motion",
                                   "Wigren, Schoukens 2017 (CED)"};
  static constexpr std::array parameters{Parameter{.name = "exponent",
                                                   .symbol = "e",
                                                   .unit = "1",
                                                   .meaning = "1: an ideal rectifier; above: one with a soft foot",
                                                   .lower = 1.0,
                                                   .upper = 3.0,
                                                   .start = 1.2,
                                                   .scan = {1.001, 1.5},
                                                   .idealised = true},
                                         Parameter{.name = "reference_speed",
                                                   .symbol = "w_r",
                                                   .unit = "rad/s",
                                                   .meaning = "speed that is shown unchanged",
                                                   .lower = 0.0,
                                                   .upper = 10.0,
                                                   .start = 1.0,
                                                   .scale = scale::speed,
                                                   .fixed = true}};
  static constexpr EffectTraits traits{.hooks = Hook::sense, .one_sided = true};

  template <class S>
  static void sense(const S* p, Reading<S>& y, const S*) {
    using std::abs;
    using std::exp;
    using std::log;
    const S size = abs(y.speed);
    if (!(value_of(p[1]) > 0.0) || value_of(size) < 1e-12 * value_of(p[1])) {
      y.speed = size;
      return;
    }
    y.speed = p[1] * exp(p[0] * log(size / p[1]));
  }
};

}  // namespace rwn
