#pragma once

#include "rwn/model/effect.hpp"

namespace rwn {

struct AmplifierGainCurve {
  static constexpr EffectInfo info{"amplifier-gain-curve", Site::actuator, "v = u (1 + g |u / V_r|^n)",
                                   "a gain that falls or rises with the command (compression, expansion of a PWM "
                                   "stage); constant from where it would turn back",
                                   "power series of an odd characteristic"};
  static constexpr std::array parameters{Parameter{.name = "gain_change",
                                                   .symbol = "g",
                                                   .unit = "1",
                                                   .meaning = "relative change of the gain at the reference command",
                                                   .lower = -0.9,
                                                   .upper = 3.0,
                                                   .start = 0.05,
                                                   .scan = {-0.1, 0.1},
                                                   .strength = true},
                                         Parameter{.name = "exponent",
                                                   .symbol = "n",
                                                   .unit = "1",
                                                   .meaning = "power of the command; 2: a cubic characteristic",
                                                   .lower = 0.3,
                                                   .upper = 6.0,
                                                   .start = 2.0},
                                         Parameter{.name = "reference_command",
                                                   .symbol = "V_r",
                                                   .unit = "V",
                                                   .meaning = "command at which the change is stated; a choice",
                                                   .lower = 0.0,
                                                   .upper = 10.0,
                                                   .start = 1.0,
                                                   .scale = scale::voltage,
                                                   .fixed = true}};
  static constexpr EffectTraits traits{.hooks = Hook::actuate, .varies = false};

  template <class S>
  static S actuate(const S* p, const S& command) {
    using std::pow;
    if (value_of(command) == 0.0) return command;
    const double sign = value_of(command) < 0.0 ? -1.0 : 1.0;
    const S size = sign * command, change = p[0] * pow(size / p[2], p[1]);
    if (value_of(change) * (1.0 + value_of(p[1])) > -1.0) return command * (1.0 + change);
    const S turning = p[2] * pow(-1.0 / (p[0] * (1.0 + p[1])), 1.0 / p[1]);  // where the slope is 0
    return sign * turning * p[1] / (1.0 + p[1]);
  }
};

}  // namespace rwn
