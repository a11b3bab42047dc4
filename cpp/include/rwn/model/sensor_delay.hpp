#pragma once

#include "rwn/model/parameter.hpp"

namespace rwn {

/// By how much a sensor shows its signal late.
inline constexpr Parameter sensor_delay{.name = "delay",
                                        .symbol = "d",
                                        .unit = "s",
                                        .meaning = "need not be a whole number of samples",
                                        .lower = 0.0,
                                        .upper = 40.0,
                                        .start = 0.8,
                                        .scale = scale::time_step,
                                        .scan = {0.3, 0.8, 1.4, 2.3, 3.6, 5.5, 8.0, 12.0, 18.0, 27.0},
                                        .strength = true};

}  // namespace rwn
