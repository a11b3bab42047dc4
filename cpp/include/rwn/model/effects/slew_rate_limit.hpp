#pragma once

#include "rwn/model/effect.hpp"

namespace rwn {

struct SlewRateLimit {
  static constexpr EffectInfo info{"slew-rate-limit", Site::actuator, "dv/dt = clip((u - v) / dt, -r, r), dt -> 0",
                                   "the amplifier, or a ramp of the drive, changes the voltage no faster", "standard"};
  static constexpr std::array parameters{Parameter{.name = "rate",
                                                   .symbol = "r",
                                                   .unit = "V/s",
                                                   .meaning = "fastest change of the voltage",
                                                   .lower = 1e-3,
                                                   .upper = 4.0,
                                                   .start = 0.2,
                                                   .scale = scale::voltage / scale::time_step,
                                                   .scan = {1.5, 0.7, 0.4, 0.1, 0.04, 0.015},
                                                   .strength = true}};
  /// Memories: the voltage that acts [V].
  static constexpr EffectTraits traits{.hooks = Hook::begin | Hook::follow, .varies = false, .memories = 1};

  template <class S>
  static void begin(const S*, const Reading<S>& first, S* memory) {
    memory[0] = first.input;
  }
  /// The mean of a ramp and of what it arrives at, also where it ends within a row.
  template <class S>
  static S follow(const S* p, const S& h, const S& input, S* memory) {
    const S gap = input - memory[0];
    const double sign = value_of(gap) < 0.0 ? -1.0 : 1.0;
    const S change = sign * p[0] * h;
    if (value_of(gap) == 0.0) return input;
    if (sign * value_of(change) < sign * value_of(gap)) {
      const S mean = memory[0] + 0.5 * change;
      memory[0] += change;
      return mean;
    }
    memory[0] = input;
    return input - 0.5 * gap * gap / change;
  }
};

}  // namespace rwn
