#pragma once

#include "rwn/effect.hpp"

namespace rwn {

struct SpeedSensorLag {
  static constexpr EffectInfo info{"speed-sensor-lag", Site::sensor, "tau dy/dt = w - y",
                                   "the speed signal is low-pass filtered", "standard"};
  static constexpr std::array parameters{Parameter{.name = "time_constant",
                                                   .unit = "s",
                                                   .meaning = "of the filter",
                                                   .lower = 1e-2,
                                                   .upper = 300.0,
                                                   .start = 3.0,
                                                   .scale = Scale::time_step,
                                                   .scan = {1.0, 5.0, 25.0},
                                                   .strength = true}};
  static constexpr int memories = 1;  // filtered speed [rad/s]
  static constexpr bool follows = true;

  template <class S>
  static void begin(const S*, const Reading<S>& first, S* memory) {
    memory[0] = first.speed;
  }
  /// Exact for speed that changes linearly over the step.
  template <class S>
  static void finish(const S* p, const Motor<S>&, const S& h, const Motion<S>& before, const Motion<S>& after,
                     S* memory) {
    using std::exp;
    const S slope = (after.speed - before.speed) / h;
    const S settled = after.speed - p[0] * slope;
    memory[0] = settled + (memory[0] - (before.speed - p[0] * slope)) * exp(-(h / p[0]));
  }
  template <class S>
  static void sense(const S*, Reading<S>& y, const S* memory) {
    y.speed = memory[0];
  }
};

}  // namespace rwn
