#pragma once

#include "rwn/model/effects/shaft_compliance.hpp"

namespace rwn {

struct LoadEncoderCompliance {
  static constexpr EffectInfo info{"load-encoder-compliance", Site::load,
                                   "T_shaft = k (theta_M - theta) + c (w_M - w); "
                                   "J_L dw/dt = T_shaft - s B w - friction",
                                   "a shaft, belt or coupling that twists between the motor and a load at which the "
                                   "motion is measured",
                                   "non-collocated control: Schroeder, Elektrische Antriebe"};
  static constexpr auto parameters = ShaftCompliance::parameters;
  static constexpr EffectTraits traits{.hooks = Hook::joint};

  template <class S>
  static Joint<S> joint(const S* p, const Motor<S>& m) {
    return with_load_first(ShaftCompliance::joint(p, m), m);
  }
};

}  // namespace rwn
