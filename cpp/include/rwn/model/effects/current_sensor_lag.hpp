#pragma once

#include "rwn/model/effect.hpp"

namespace rwn {

struct CurrentSensorLag {
  static constexpr EffectInfo info{"current-sensor-lag", Site::sensor, "tau dy/dt = i - y",
                                   "the current signal is low-pass filtered", "standard"};
  static constexpr std::array parameters{Parameter{.name = "time_constant",
                                                   .symbol = "tau",
                                                   .unit = "s",
                                                   .meaning = "of the filter",
                                                   .lower = 1e-2,
                                                   .upper = 300.0,
                                                   .start = 1.0,
                                                   .scale = scale::time_step,
                                                   .scan = {0.5, 2.0, 8.0},
                                                   .strength = true}};
  /// Memories: filtered current [A].
  static constexpr EffectTraits traits{
      .hooks = Hook::begin | Hook::finish | Hook::sense, .filters = "current", .memories = 1};

  static constexpr double slow = 1e-4;  // a step in time constants that is as good as none

  template <class S>
  static void begin(const S*, const Reading<S>& first, S* memory) {
    memory[0] = first.current;
  }
  /// Exact for the current of R and L under a voltage that is constant over the step, whatever takes a part of it, and
  /// a speed that is quadratic: i = c0 + c1 s + c2 s^2 + h exp(-f s), s from 0 to 1.
  template <class S>
  static void finish(const S* p, const Motor<S>&, const S& h, const Motion<S>& before, const Motion<S>& after,
                     S* memory) {
    using std::exp;
    using std::expm1;
    const Winding<S>& winding = *before.winding;
    const S f = h * winding.resistance / winding.inductance, g = h / p[0];
    const S gone = -expm1(-g);  // what is kept of 1, s, s^2 and exp(-f s)
    const S rise = 1.0 - gone / g, square = 1.0 - 2.0 * rise / g;
    const S change = after.current - before.current;
    if (value_of(f) < slow) {
      memory[0] += gone * (before.current - memory[0]) + rise * change;
      return;
    }
    const S emf = winding.back_emf_constant / winding.resistance;
    const S bow = 6.0 * (after.travel / h) - 3.0 * (before.speed + after.speed);
    const S c2 = emf * bow;
    const S c1 = -emf * (after.speed - before.speed + bow) - 2.0 * c2 / f;
    const S transient = (c1 + c2 - change) / -expm1(-f);
    const S apart = g - f;
    const S mixed = std::abs(value_of(apart)) > slow ? g * (exp(-f) - exp(-g)) / apart : g * exp(-g);
    memory[0] += gone * (before.current - transient - memory[0]) + c1 * rise + c2 * square + transient * mixed;
  }
  template <class S>
  static void sense(const S*, Reading<S>& y, const S* memory) {
    y.current = memory[0];
  }
};

}  // namespace rwn
