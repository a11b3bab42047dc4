// The quantity that a parameter is measured against, so that bounds and first guesses fit a 1 W and a 500 W motor.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace rwn {

/// A product of powers of quantities that every drive has; a parameter writes its own: torque / (speed * speed).
struct Scale {
  /// torque, speed, voltage, current: the largest of the recordings; inertia: the motor's; time_step, duration: of the
  /// recordings; loss: the largest mean loss R i^2 of the winding [W].
  static constexpr std::array<std::string_view, 8> quantities{"torque",  "speed",     "voltage",  "current",
                                                              "inertia", "time_step", "duration", "loss"};
  std::array<int, quantities.size()> powers{};
  double factor = 1.0;

  friend constexpr Scale operator*(Scale a, const Scale& b) {
    for (std::size_t k = 0; k < a.powers.size(); ++k) a.powers[k] += b.powers[k];
    a.factor *= b.factor;
    return a;
  }
  friend constexpr Scale operator*(double factor, Scale a) {
    a.factor *= factor;
    return a;
  }
  friend constexpr Scale operator/(Scale a, const Scale& b) {
    for (std::size_t k = 0; k < a.powers.size(); ++k) a.powers[k] -= b.powers[k];
    a.factor /= b.factor;
    return a;
  }
  friend constexpr bool operator==(const Scale&, const Scale&) = default;
};

namespace scale {

inline constexpr Scale none{};
inline constexpr Scale torque{{1}}, speed{{0, 1}}, voltage{{0, 0, 1}}, current{{0, 0, 0, 1}};
inline constexpr Scale inertia{{0, 0, 0, 0, 1}}, time_step{{0, 0, 0, 0, 0, 1}}, duration{{0, 0, 0, 0, 0, 0, 1}};
inline constexpr Scale loss{{0, 0, 0, 0, 0, 0, 0, 1}};
inline constexpr Scale damping = torque / speed;
/// Of a spring that swings by 0.3 rad a sample, were all of the inertia behind it.
inline constexpr Scale stiffness = 0.09 * inertia / (time_step * time_step);

}  // namespace scale
}  // namespace rwn
