#pragma once

#include "rwn/model/effect.hpp"
#include "rwn/model/sensor_delay.hpp"

namespace rwn {

struct SpeedSensorDelay {
  static constexpr EffectInfo info{"speed-sensor-delay", Site::sensor, "y(t) = w(t - d)",
                                   "speed and position are shown late against the current", "standard"};
  static constexpr std::array parameters{sensor_delay};
  static constexpr EffectTraits traits{.hooks = Hook::late, .varies = false, .shows_late = "speed"};

  template <class S>
  static S late(const S* p) {
    return p[0];
  }
};

}  // namespace rwn
