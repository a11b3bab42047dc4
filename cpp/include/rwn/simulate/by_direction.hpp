// What depends on the direction of sliding alone, made once for each.
#pragma once

#include <array>
#include <cstddef>

namespace rwn {

template <class T>
class ByDirection {
 public:
  /// Of sliding back (< 0), standing (0) or sliding forth; `make` gives it the first time.
  template <class Make>
  const T& at(double direction, const Make& make) {
    const std::size_t place = direction > 0.0 ? 2 : direction < 0.0 ? 0 : 1;
    if (!known_[place]) values_[place] = make();
    known_[place] = true;
    return values_[place];
  }

  void forget() { known_ = {}; }

 private:
  std::array<T, 3> values_{};
  std::array<bool, 3> known_{};
};

}  // namespace rwn
