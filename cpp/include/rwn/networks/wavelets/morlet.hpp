#pragma once

#include <cmath>
#include <string_view>

namespace rwn {

/// Morlet (cos-Gaussian), phi(z) = exp(-z^2/2) cos(omega0 z) (thesis eq. 2.3). Its mean is zero only for large
/// omega0: 9e-6 at 5, 0.54 at 1.75 (docs/errata.md); the thesis does not state omega0.
struct Morlet {
  static constexpr std::string_view name = "morlet";
  double omega0 = 5.0;

  static constexpr double max_value() { return 1.0; }  // at z = 0
  double max_derivative() const;                       // computed by a search: keep it, do not call it in a loop
  double max_scaled_derivative() const;

  template <class T>
  T value(const T& z) const {
    using std::cos;
    using std::exp;
    return exp(-0.5 * z * z) * cos(omega0 * z);
  }
  template <class T>
  T derivative(const T& z) const {
    using std::cos;
    using std::exp;
    using std::sin;
    return -exp(-0.5 * z * z) * (z * cos(omega0 * z) + omega0 * sin(omega0 * z));
  }
  template <class T>
  T second_derivative(const T& z) const {
    using std::cos;
    using std::exp;
    using std::sin;
    return exp(-0.5 * z * z) * ((z * z - 1.0 - omega0 * omega0) * cos(omega0 * z) + 2.0 * omega0 * z * sin(omega0 * z));
  }
};

}  // namespace rwn
