#pragma once

#include "rwn/model/effect.hpp"

namespace rwn {

struct SpeedMovingAverage {
  static constexpr EffectInfo info{"speed-moving-average", Site::sensor, "T^2/12 d2y/dt2 + T/2 dy/dt + y = w",
                                   "the speed is its mean over the last T, or went through a filter of second order",
                                   "Pade approximation of (1 - exp(-s T)) / (s T)"};
  static constexpr std::array parameters{Parameter{.name = "window",
                                                   .symbol = "T",
                                                   .unit = "s",
                                                   .meaning = "over which the speed is averaged",
                                                   .lower = 0.1,
                                                   .upper = 300.0,
                                                   .start = 3.0,
                                                   .scale = scale::time_step,
                                                   .scan = {1.5, 6.0, 15.0, 50.0},
                                                   .strength = true}};
  /// Memories: mean speed [rad/s] and its derivative.
  static constexpr EffectTraits traits{.hooks = Hook::begin | Hook::finish | Hook::sense, .memories = 2};

  template <class S>
  static void begin(const S*, const Reading<S>& first, S* memory) {
    memory[0] = first.speed;
    memory[1] = S(0.0);
  }
  /// Exact for a speed that is quadratic over the step: that with these ends and this travel.
  template <class S>
  static void finish(const S* p, const Motor<S>&, const S& h, const Motion<S>& before, const Motion<S>& after,
                     S* memory) {
    using std::cos;
    using std::exp;
    using std::sin;
    const double root = 1.7320508075688772;  // the poles are at (-3 +- i sqrt(3)) / T
    const S window = p[0] / h, x = h / p[0];
    const S bow = 6.0 * (after.travel / h) - 3.0 * (before.speed + after.speed);
    const S slope = after.speed - before.speed + bow;  // w = before + slope s - bow s^2, s from 0 to 1
    const S b = slope + window * bow;                  // follows as a + b s - bow s^2 once the past is forgotten
    const S a = before.speed - 0.5 * window * b + window * window * bow / 6.0;
    const S off = memory[0] - a;
    const S turned = (h * memory[1] - b + 3.0 * x * off) / (root * x);
    const S fades = exp(-3.0 * x), c = fades * cos(root * x), s = fades * sin(root * x);
    memory[0] = a + b - bow + off * c + turned * s;
    memory[1] = (b - 2.0 * bow + x * ((root * turned - 3.0 * off) * c - (3.0 * turned + root * off) * s)) / h;
  }
  template <class S>
  static void sense(const S*, Reading<S>& y, const S* memory) {
    y.speed = memory[0];
  }
};

}  // namespace rwn
