#pragma once

#include <algorithm>
#include <cmath>

#include "rwn/model/effect.hpp"

namespace rwn {

struct BrushVoltageDrop {
  static constexpr EffectInfo info{"brush-voltage-drop", Site::voltage, "v_b = V_b tanh(i / i_b)",
                                   "contact voltage of the brushes, nearly independent of current",
                                   "Fitzgerald, Electric Machinery; saturates over the transition current i_b"};
  static constexpr std::array parameters{Parameter{.name = "voltage_drop",
                                                   .symbol = "V_b",
                                                   .unit = "V",
                                                   .meaning = "total drop at large current",
                                                   .lower = 0.0,
                                                   .upper = 1.0,
                                                   .start = 0.03,
                                                   .scale = scale::voltage,
                                                   .strength = true},
                                         Parameter{.name = "transition_current",
                                                   .symbol = "i_b",
                                                   .unit = "A",
                                                   .meaning = "current over which the drop builds up",
                                                   .lower = 5e-3,  // already as good as abrupt
                                                   .upper = 0.2,
                                                   .start = 0.02,
                                                   .scale = scale::current,
                                                   .idealised = true}};
  static constexpr EffectTraits traits{.hooks = Hook::apply | Hook::rate};

  template <class S>
  static void apply(const S* p, const Motor<S>&, const Motion<S>& x, Terms<S>& t) {
    using std::tanh;
    const S share = tanh(x.current / p[1]);
    t.drop += p[0] * share;
    t.drop_slope += value_of(p[0]) / value_of(p[1]) * (1.0 - value_of(share) * value_of(share));
  }
  /// The drop changes sign within a step where the current does: how often it passes the transition then.
  template <class S>
  static double rate(const S* p, const Motor<S>&, const Motion<S>& x, double, double) {
    const Winding<S>& winding = *x.winding;
    const double transition = value_of(p[1]), i = value_of(x.current);
    const double drive = value_of(winding.driving_voltage(x.speed, x.input));
    const double drop = value_of(p[0]) * std::tanh(i / transition);
    const double settled = (drive - drop) / value_of(winding.resistance);
    const double reach = 4.0 * transition;
    if (std::min(i, settled) > reach || std::max(i, settled) < -reach) return 0.0;
    return std::abs(drive - drop - value_of(winding.resistance) * i) / (value_of(winding.inductance) * transition);
  }
};

}  // namespace rwn
