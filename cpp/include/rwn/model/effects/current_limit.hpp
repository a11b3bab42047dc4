#pragma once

#include "rwn/model/effect.hpp"

namespace rwn {

struct CurrentLimit {
  static constexpr EffectInfo info{"current-limit", Site::voltage, "v = clip(u, Ke w - R I_m, Ke w + R I_m)",
                                   "the drive gives no more voltage than its largest current takes", "standard"};
  static constexpr std::array parameters{Parameter{.name = "limit",
                                                   .symbol = "I_m",
                                                   .unit = "A",
                                                   .meaning = "largest current",
                                                   .lower = 0.05,
                                                   .upper = 2.0,
                                                   .start = 0.9,
                                                   .scale = scale::current,
                                                   .scan = {0.4, 0.6, 0.8, 1.0},
                                                   .strength = true}};
  static constexpr EffectTraits traits{.hooks = Hook::apply | Hook::rate};

  template <class S>
  static void apply(const S* p, const Motor<S>& motor, const Motion<S>& x, Terms<S>& t) {
    const S emf = motor[back_emf_constant] * x.speed;
    const S most = motor[resistance] * p[0];
    const S driving = x.input - emf;
    if (value_of(driving) > value_of(most)) t.drop += driving - most;
    if (value_of(driving) < -value_of(most)) t.drop += driving + most;
  }
  /// Where it limits, it takes the back-EMF out of the equations, and its damping with it.
  template <class S>
  static double rate(const S* p, const Motor<S>& m, const Motion<S>& x, double, double) {
    const double driving = value_of(x.input) - value_of(m[back_emf_constant]) * value_of(x.speed);
    return std::abs(driving) > value_of(m[resistance]) * value_of(p[0]) ? damping_of_back_emf(m) : 0.0;
  }
};

}  // namespace rwn
