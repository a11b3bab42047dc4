#pragma once

#include "rwn/model/effect.hpp"

namespace rwn {

struct CurrentLimit {
  static constexpr EffectInfo info{"current-limit", Site::voltage,
                                   "v = min(u, Ke w + R i + c R (I_m - i)), likewise below",
                                   "the drive gives no more voltage than brings the current to its limit",
                                   "Leonhard, Control of Electrical Drives: a current loop that takes over at a limit"};
  static constexpr std::array parameters{Parameter{.name = "limit",
                                                   .symbol = "I_m",
                                                   .unit = "A",
                                                   .meaning = "largest current",
                                                   .lower = 0.05,
                                                   .upper = 2.0,
                                                   .start = 0.9,
                                                   .scale = scale::current,
                                                   .scan = {0.4, 0.6, 0.8, 1.0},
                                                   .strength = true},
                                         Parameter{.name = "bandwidth",
                                                   .symbol = "c",
                                                   .unit = "1",
                                                   .meaning = "how many times as fast as L/R it is reached",
                                                   .lower = 1.0,   // the voltage at the limit, at once
                                                   .upper = 20.0,  // already as good as all of u until it is reached
                                                   .start = 3.0,
                                                   .idealised = true}};
  static constexpr EffectTraits traits{.hooks = Hook::apply | Hook::rate};

  /// A current that is on its way to the limit is linearised as it will be there: a step may end where it limits.
  template <class S>
  static void apply(const S* p, const Motor<S>&, const Motion<S>& x, Terms<S>& t) {
    const Winding<S>& winding = *x.winding;
    const double sign = driven(x) < 0.0 ? -1.0 : 1.0;
    if (std::abs(driven(x)) <= value_of(winding.resting_voltage(p[0]))) return;
    const S left = winding.driving_voltage(x.speed, x.input) - winding.resting_voltage(x.current);
    const S excess = left - p[1] * winding.resistance * (sign * p[0] - x.current);
    if (sign * value_of(excess) > 0.0) t.drop += excess;
    t.drop_slope += (value_of(p[1]) - 1.0) * value_of(winding.resistance);
  }
  /// Where it limits throughout, it takes the back-EMF out of the equations, and its damping with it. Where it may
  /// begin or end to limit within a step: how fast the current then settles.
  template <class S>
  static double rate(const S* p, const Motor<S>& m, const Motion<S>& x, double acceleration, double h) {
    const Winding<S>& winding = *x.winding;
    const double r = value_of(winding.resistance), limit = value_of(p[0]), c = value_of(p[1]), drive = driven(x);
    const double changes = value_of(winding.back_emf_constant) * acceleration * h;
    if (std::abs(drive) + changes <= r * limit) return 0.0;
    const double sign = drive < 0.0 ? -1.0 : 1.0, i = sign * value_of(x.current);
    const bool limits = std::abs(drive) - r * i > c * r * (limit - i);
    if (limits && std::abs(drive) - changes > r * limit) return winding.braking_rate(value_of(m[inertia]));
    return c * r / value_of(winding.inductance);
  }

 private:
  /// What drives a current [V].
  template <class S>
  static double driven(const Motion<S>& x) {
    return value_of(x.winding->driving_voltage(x.speed, x.input));
  }
};

}  // namespace rwn
