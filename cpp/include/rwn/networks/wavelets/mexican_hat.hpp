#pragma once

#include <cmath>
#include <string_view>

namespace rwn {

/// Mexican hat, phi(z) = (1 - z^2) exp(-z^2/2): the negative second derivative of the Gaussian.
struct MexicanHat {
  static constexpr std::string_view name = "mexican-hat";
  static constexpr double max_value() { return 1.0; }
  static constexpr double max_derivative() { return 1.3801198; }
  static constexpr double max_scaled_derivative() { return 1.2130614; }

  template <class T>
  T value(const T& z) const {
    using std::exp;
    return (1.0 - z * z) * exp(-0.5 * z * z);
  }
  template <class T>
  T derivative(const T& z) const {
    using std::exp;
    return z * (z * z - 3.0) * exp(-0.5 * z * z);
  }
  template <class T>
  T second_derivative(const T& z) const {
    using std::exp;
    const T s = z * z;
    return (s * (6.0 - s) - 3.0) * exp(-0.5 * s);
  }
};

}  // namespace rwn
