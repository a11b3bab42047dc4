#pragma once

#include "rwn/model/effect.hpp"

namespace rwn {

struct VoltageSaturation {
  static constexpr EffectInfo info{"voltage-saturation", Site::actuator, "v = clip(u, -V_m, V_m)",
                                   "the supply cannot give the commanded voltage", "standard"};
  static constexpr std::array parameters{Parameter{.name = "limit",
                                                   .symbol = "V_m",
                                                   .unit = "V",
                                                   .meaning = "largest voltage",
                                                   .lower = 0.05,
                                                   .upper = 1.5,  // the scale leaves out the highest peaks
                                                   .start = 0.8,
                                                   .scale = scale::voltage,
                                                   .scan = {0.5, 0.7, 0.85, 0.95, 1.02},
                                                   .strength = true}};
  static constexpr EffectTraits traits{.hooks = Hook::actuate, .varies = false};

  template <class S>
  static S actuate(const S* p, const S& command) {
    if (value_of(command) > value_of(p[0])) return p[0];
    if (value_of(command) < -value_of(p[0])) return -p[0];
    return command;
  }
};

}  // namespace rwn
