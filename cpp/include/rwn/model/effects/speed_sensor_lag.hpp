#pragma once

#include "rwn/model/effect.hpp"

namespace rwn {

struct SpeedSensorLag {
  static constexpr EffectInfo info{"speed-sensor-lag", Site::sensor, "tau dy/dt = w - y",
                                   "the speed signal is low-pass filtered", "standard"};
  static constexpr std::array parameters{Parameter{.name = "time_constant",
                                                   .symbol = "tau",
                                                   .unit = "s",
                                                   .meaning = "of the filter",
                                                   .lower = 1e-2,
                                                   .upper = 300.0,
                                                   .start = 3.0,
                                                   .scale = scale::time_step,
                                                   .scan = {1.0, 5.0, 25.0},
                                                   .strength = true}};
  /// Memories: filtered speed [rad/s].
  static constexpr EffectTraits traits{
      .hooks = Hook::begin | Hook::finish | Hook::sense, .filters = "speed", .memories = 1};

  static constexpr double small = 1e-3;  // of steps in time constants: three terms of a series are exact to 1e-9

  template <class S>
  static void begin(const S*, const Reading<S>& first, S* memory) {
    memory[0] = first.speed;
  }
  /// Exact for a speed that is quadratic over the step: that with these ends and this travel. Where the current settles
  /// within a sample a straight line is not enough.
  template <class S>
  static void finish(const S* p, const Motor<S>&, const S& h, const Motion<S>& before, const Motion<S>& after,
                     S* memory) {
    using std::expm1;
    const S x = h / p[0];
    const S settled = -expm1(-x);  // answer to a step of 1, to a rise of 1 and to s (1 - s), s from 0 to 1
    const S mean = settled / x;
    const bool brief = value_of(x) < small;  // there the differences are known by their series alone
    const S risen = brief ? x * (0.5 - x * (1.0 / 6.0 - x / 24.0)) : 1.0 - mean;
    const S bowed = brief ? x * (1.0 / 6.0 - x * (1.0 / 12.0 - x / 40.0)) : 2.0 * risen / x - mean;
    const S bow = 6.0 * (after.travel / h) - 3.0 * (before.speed + after.speed);
    memory[0] += settled * (before.speed - memory[0]) + risen * (after.speed - before.speed) + bowed * bow;
  }
  template <class S>
  static void sense(const S*, Reading<S>& y, const S* memory) {
    y.speed = memory[0];
  }
};

}  // namespace rwn
