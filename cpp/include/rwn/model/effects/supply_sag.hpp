#pragma once

#include "rwn/model/effect.hpp"

namespace rwn {

struct SupplySag {
  static constexpr EffectInfo info{"supply-sag", Site::voltage, "v = clip(u, -V_m, V_m), V_m = V_0 - R_s |i|",
                                   "the supply gives the less voltage, the more current it carries", "Thevenin source"};
  static constexpr std::array parameters{Parameter{.name = "open_circuit_voltage",
                                                   .symbol = "V_0",
                                                   .unit = "V",
                                                   .meaning = "largest voltage without a current",
                                                   .lower = 0.05,
                                                   .upper = 2.0,
                                                   .start = 0.9,
                                                   .scale = scale::voltage,
                                                   .scan = {0.7, 0.85, 1.0, 1.15}},
                                         Parameter{.name = "internal_resistance",
                                                   .symbol = "R_s",
                                                   .unit = "ohm",
                                                   .meaning = "of the supply and its cables",
                                                   .lower = 0.0,
                                                   .upper = 2.0,
                                                   .start = 0.15,
                                                   .scale = scale::voltage / scale::current,
                                                   .strength = true}};
  static constexpr EffectTraits traits{.hooks = Hook::apply, .special_case = "voltage-saturation"};

  template <class S>
  static void apply(const S* p, const Motor<S>&, const Motion<S>& x, Terms<S>& t) {
    const double sign = value_of(x.input) < 0.0 ? -1.0 : 1.0;
    const double flow = value_of(x.current) < 0.0 ? -1.0 : 1.0;
    const S left = p[0] - p[1] * (flow * x.current);
    const S given = value_of(left) > 0.0 ? left : S(0.0);
    const S missing = sign * x.input - given;
    if (value_of(missing) <= 0.0) return;
    t.drop += sign * missing;
    if (value_of(left) > 0.0) t.drop_slope += sign * flow * value_of(p[1]);
  }
  static void specialise(const double* p, double* limit) { limit[0] = p[0]; }
};

}  // namespace rwn
