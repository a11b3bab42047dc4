#pragma once

#include "rwn/effect.hpp"

namespace rwn {

struct BrushVoltageDrop {
  static constexpr EffectInfo info{"brush-voltage-drop", Site::voltage, "v_b = V_b tanh(i / i_b)",
                                   "contact voltage of the brushes, nearly independent of current",
                                   "Fitzgerald, Electric Machinery; saturates over the transition current i_b"};
  static constexpr std::array parameters{Parameter{.name = "voltage_drop",
                                                   .unit = "V",
                                                   .meaning = "total drop at large current",
                                                   .lower = 0.0,
                                                   .upper = 0.5,
                                                   .start = 0.03,
                                                   .scale = Scale::voltage,
                                                   .strength = true},
                                         Parameter{.name = "transition_current",
                                                   .unit = "A",
                                                   .meaning = "current over which the drop builds up",
                                                   .lower = 1e-3,
                                                   .upper = 0.2,
                                                   .start = 0.02,
                                                   .scale = Scale::current}};

  template <class S>
  static void apply(const S* p, const Motor<S>&, const Motion<S>& x, Terms<S>& t) {
    using std::tanh;
    const S share = tanh(x.current / p[1]);
    t.drop += p[0] * share;
    t.drop_slope += value_of(p[0]) / value_of(p[1]) * (1.0 - value_of(share) * value_of(share));
  }
};

}  // namespace rwn
