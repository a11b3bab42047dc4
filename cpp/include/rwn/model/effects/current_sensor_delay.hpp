#pragma once

#include "rwn/model/effect.hpp"
#include "rwn/model/sensor_delay.hpp"

namespace rwn {

struct CurrentSensorDelay {
  static constexpr EffectInfo info{"current-sensor-delay", Site::sensor, "y(t) = i(t - d)",
                                   "the current is shown late against the other channels", "standard"};
  static constexpr std::array parameters{sensor_delay};
  static constexpr EffectTraits traits{.hooks = Hook::late, .varies = false, .shows_late = "current"};

  template <class S>
  static S late(const S* p) {
    return p[0];
  }
};

}  // namespace rwn
