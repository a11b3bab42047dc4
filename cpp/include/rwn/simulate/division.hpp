// Into which steps an interval of constant input is divided.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "rwn/simulate/winding_level.hpp"

namespace rwn {

/// Steps for the transient of a winding come first and grow with it; what is left is divided evenly.
class Division {
 public:
  Division() = default;

  /// For a winding that settles at 2^level times its rate R/L and passes where it is slower, and for so many steps
  /// over h as effects ask for.
  Division(double h, double rate, int level, double steps) {
    double length = angle_of_a_winding / (rate * resistances_of(level));
    const int most = std::min(2 + level, most_transients);
    for (; transients_ < most && h - gone_ > length && steps * length <= h; ++transients_, length *= 2.0) {
      transient_[static_cast<std::size_t>(transients_)] = length;
      gone_ += length;
    }
    ask(steps * (1.0 - gone_ / h));
  }

  /// For effects alone.
  explicit Division(double steps) { ask(steps); }

  /// At least so many steps for what is left.
  void ask(double steps) {
    if (steps > even_) even_ = static_cast<int>(std::min(std::ceil(steps), 16.0));
  }

  int count() const { return transients_ + even_; }

  /// The k-th length of an interval of length h.
  template <class S>
  S length(int k, const S& h) const {
    if (k < transients_) return S(transient_[static_cast<std::size_t>(k)]);
    return count() == 1 ? h : (h - gone_) / static_cast<double>(even_);
  }

 private:
  static constexpr int most_transients = 6;
  std::array<double, most_transients> transient_{};
  double gone_ = 0.0;
  int transients_ = 0, even_ = 1;
};

}  // namespace rwn
