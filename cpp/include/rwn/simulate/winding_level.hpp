// How a winding is linearised that has become faster than R/L: at 2^level times its resistance.
#pragma once

#include <algorithm>
#include <cmath>

namespace rwn {

inline constexpr double angle_of_a_winding = 1.4;  // R/L h of a step, where its equation is nearly linear

/// Of a winding that is so many times as fast as R/L; 0 nearly always.
inline int level_of(double speed_up) {
  return speed_up > 1.3 ? static_cast<int>(std::min(12.0, std::ceil(std::log2(speed_up)))) : 0;
}

/// 2^level.
inline double resistances_of(int level) { return level == 0 ? 1.0 : std::ldexp(1.0, level); }

}  // namespace rwn
