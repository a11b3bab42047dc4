#pragma once

#include "rwn/model/effect.hpp"

namespace rwn {

struct ResistanceHeating {
  static constexpr EffectInfo info{
      "resistance-heating", Site::voltage, "R(T) = R (1 + alpha dT), C_th d(dT)/dt = R(T) i^2 - dT/R_th",
      "winding resistance that rises as the winding warms up; ambient at the start", "IEC 60034-1; alpha of copper"};
  static constexpr std::array parameters{Parameter{.name = "thermal_resistance",
                                                   .symbol = "R_th",
                                                   .unit = "K/W",
                                                   .meaning = "winding to ambient",
                                                   .lower = 0.1,
                                                   .upper = 1e4,
                                                   .start = 50.0,
                                                   .scale = scale::none / scale::loss,
                                                   .scan = {20.0, 200.0},
                                                   .strength = true},
                                         Parameter{.name = "heat_capacity",
                                                   .symbol = "C_th",
                                                   .unit = "J/K",
                                                   .meaning = "of the winding",
                                                   .lower = 1e-4,
                                                   .upper = 1e2,
                                                   .start = 0.02,
                                                   .scale = scale::loss * scale::duration,
                                                   .scan = {0.002, 0.02, 0.2}},
                                         Parameter{.name = "temperature_coefficient",
                                                   .symbol = "alpha",
                                                   .unit = "1/K",
                                                   .meaning = "of the resistance",
                                                   .lower = 0.0,
                                                   .upper = 0.02,
                                                   .start = 0.00393,
                                                   .fixed = true}};
  /// Memories: winding temperature above ambient now and in the middle of the next step [K].
  static constexpr EffectTraits traits{.hooks = Hook::apply | Hook::finish, .memories = 2};
  /// Mean of i^2 over a step: the current goes exponentially to where it settles, which the speed moves meanwhile.
  template <class S>
  static S mean_square(const S& h, const Motion<S>& before, const Motion<S>& after) {
    using std::exp;
    const Winding<S>& winding = *before.winding;
    const S a = before.current, b = after.current, rate = h * winding.resistance / winding.inductance;
    if (value_of(rate) < 0.05) return (a * a + a * b + b * b) / 3.0;
    const S left = exp(-rate), mean = (1.0 - left) / rate;  // of the decaying part
    const S ramp = -winding.back_emf(after.speed - before.speed) / winding.resistance;
    const S gap = (a - b + ramp) / (1.0 - left), settled = a - gap;
    return settled * settled + settled * ramp + ramp * ramp / 3.0 +
           2.0 * gap * (settled * mean + ramp * (mean - left) / rate) +
           gap * gap * (1.0 - left * left) / (2.0 * rate);
  }

  template <class S>
  static void apply(const S* p, const Motor<S>&, const Motion<S>& x, Terms<S>& t) {
    t.resistance += p[2] * x.memory[1];
  }
  template <class S>
  static void finish(const S* p, const Motor<S>&, const S& h, const Motion<S>& before, const Motion<S>& after,
                     S* memory) {
    using std::exp;
    const S power = before.winding->resistance * (1.0 + p[2] * memory[1]) * mean_square(h, before, after);
    const S settled = p[0] * power, half = exp(-(h / (2.0 * p[0] * p[1])));
    memory[0] = settled + (memory[0] - settled) * half * half;
    memory[1] = settled + (memory[0] - settled) * half;
  }
};

}  // namespace rwn
