// Parameters that effects which come back with the angle have in common.
#pragma once

#include "rwn/model/parameter.hpp"

namespace rwn::periodic {

inline constexpr Parameter peak_torque{.name = "amplitude",
                                       .symbol = "A",
                                       .unit = "N m",
                                       .meaning = "peak torque",
                                       .lower = 0.0,
                                       .upper = 1.0,
                                       .start = 0.03,
                                       .scale = scale::torque,
                                       .strength = true};
/// A peak torque that is tried from weak to strong: a strong one traps the motor, and no small step leads there.
inline constexpr Parameter any_peak_torque = [] {
  Parameter p = peak_torque;
  p.scan = {0.03, 0.15, 0.6};
  return p;
}();
inline constexpr Parameter phase{.name = "phase",
                                 .symbol = "p",
                                 .unit = "rad",
                                 .meaning = "at position 0",
                                 .lower = -6.4,
                                 .upper = 6.4,
                                 .start = 0.0,
                                 .scan = {0.0, 1.5707963, 3.1415927, -1.5707963},
                                 .cyclic = true};

}  // namespace rwn::periodic
