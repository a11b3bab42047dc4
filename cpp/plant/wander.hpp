// A torque that wanders at random, the same for the same seed.
#pragma once

#include <cstdint>
#include <vector>

namespace rwn {

/// An Ornstein-Uhlenbeck process of this rms and correlation time, as straight lines between the nodes of a fine grid.
class Wander {
 public:
  Wander(double rms, double time, double seed);

  /// Draws the nodes up to `time`; must come before `at` asks for it.
  void extend(double time);
  double at(double time) const;
  bool still() const { return rms_ == 0.0; }

 private:
  double normal();

  double rms_, spacing_, memory_;
  std::uint64_t state_;
  std::vector<double> nodes_;
};

}  // namespace rwn
