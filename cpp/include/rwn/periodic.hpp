// Parameters that effects which come back with the angle have in common.
#pragma once

#include "rwn/parameter.hpp"

namespace rwn::periodic {

inline constexpr Parameter peak_torque{.name = "amplitude",
                                       .unit = "N m",
                                       .meaning = "peak torque",
                                       .lower = 0.0,
                                       .upper = 1.0,
                                       .start = 0.03,
                                       .scale = Scale::torque,
                                       .strength = true};
inline constexpr Parameter phase{.name = "phase",
                                 .unit = "rad",
                                 .meaning = "at position 0",
                                 .lower = -6.4,
                                 .upper = 6.4,
                                 .start = 0.0,
                                 .scan = {0.0, 1.5707963, 3.1415927, -1.5707963},
                                 .cyclic = true};

}  // namespace rwn::periodic
