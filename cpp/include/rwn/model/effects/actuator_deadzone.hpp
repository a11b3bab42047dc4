#pragma once

#include "rwn/model/effect.hpp"

namespace rwn {

struct ActuatorDeadzone {
  static constexpr EffectInfo info{"actuator-deadzone", Site::actuator, "v = sign(u) max(|u| - V_d, 0)",
                                   "the amplifier passes nothing of small commands (dead time of a bridge)",
                                   "thesis ref. 21"};
  static constexpr std::array parameters{Parameter{.name = "deadzone",
                                                   .symbol = "V_d",
                                                   .unit = "V",
                                                   .meaning = "command below which nothing acts",
                                                   .lower = 0.0,
                                                   .upper = 0.8,
                                                   .start = 0.03,
                                                   .scale = scale::voltage,
                                                   .scan = {0.02, 0.1},
                                                   .strength = true}};
  static constexpr EffectTraits traits{.hooks = Hook::actuate, .varies = false, .holds = true};

  template <class S>
  static S actuate(const S* p, const S& command) {
    if (value_of(command) > value_of(p[0])) return command - p[0];
    if (value_of(command) < -value_of(p[0])) return command + p[0];
    return S(0.0);
  }
};

}  // namespace rwn
