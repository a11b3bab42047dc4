#pragma once

#include "rwn/effect.hpp"

namespace rwn {

struct SensorRectification {
  static constexpr EffectInfo info{"sensor-rectification", Site::sensor, "y = |w|",
                                   "the speed sensor does not see the direction", "Wigren, Schoukens 2017 (CED)"};
  static constexpr std::array<Parameter, 0> parameters{};

  template <class S>
  static void sense(const S*, Reading<S>& y, const S*) {
    using std::abs;
    y.speed = abs(y.speed);
  }
};

}  // namespace rwn
