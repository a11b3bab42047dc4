#pragma once

#include <cmath>
#include <string_view>

namespace rwn {

/// First derivative of the Gaussian, phi(z) = -z exp(-z^2/2) (thesis eq. 2.2, 2.6).
struct GaussianDerivative {
  static constexpr std::string_view name = "gaussian-derivative";
  static constexpr double max_value() { return 0.60653065971263342; }  // max |phi|, at z = 1
  static constexpr double max_derivative() { return 1.0; }  // max |phi'|, at z = 0
  static constexpr double max_scaled_derivative() { return 0.81669145087; }  // max |z phi'|, at z = 1.932, rounded up

  template <class T>
  T value(const T& z) const {
    using std::exp;
    return -z * exp(-0.5 * z * z);
  }
  template <class T>
  T derivative(const T& z) const {
    using std::exp;
    return (z * z - 1.0) * exp(-0.5 * z * z);
  }
  template <class T>
  T second_derivative(const T& z) const {
    using std::exp;
    return z * (3.0 - z * z) * exp(-0.5 * z * z);
  }
};

}  // namespace rwn
