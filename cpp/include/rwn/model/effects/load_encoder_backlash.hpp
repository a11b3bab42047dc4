#pragma once

#include "rwn/model/effects/backlash.hpp"

namespace rwn {

struct LoadEncoderBacklash {
  static constexpr EffectInfo info{"load-encoder-backlash", Site::load,
                                   "T_shaft = k dead(theta_M - theta, gap) + c (w_M - w) in contact, never pulls; "
                                   "J_L dw/dt = T_shaft - s B w - friction",
                                   "play between the motor and a load at which the motion is measured",
                                   "Nordin, Gutman 2002; contact: Brogliato 1999, ch. 2"};
  static constexpr auto parameters = Backlash::parameters;
  static constexpr EffectTraits traits{.hooks = Hook::joint};

  template <class S>
  static Joint<S> joint(const S* p, const Motor<S>& m) {
    return with_load_first(Backlash::joint(p, m), m);
  }
};

}  // namespace rwn
