// The torque of a drive: of all of its kinds, whether a winding makes it or it is the input.
#pragma once

#include "rwn/model/motor.hpp"

namespace rwn {

template <class S, class Drive>
struct DriveTorque {
  using Electrics = typename Drive::template Electrics<S>;

  /// The part that the linear equations hold.
  static S linear(const Electrics& electrics, const auto& x) {
    if constexpr (Drive::states > 0) return electrics.linear_torque(x);
    return S(0.0);
  }

  /// The part that is the input itself.
  static S given(const S& input) {
    if constexpr (Drive::forced) return input;
    return S(0.0);
  }
};

}  // namespace rwn
