#include "rwn/networks/wavelets/morlet.hpp"

#include <algorithm>
#include <cmath>

namespace rwn {
namespace {

/// Largest f over z in [0, 12]: a scan finer than an oscillation, then golden section around its best point.
template <class F>
double largest(F f, double omega0) {
  const double step = std::min(0.02, 0.05 / omega0);
  double best = 0.0;
  for (double z = 0.0; z < 12.0; z += step) {
    best = f(z) > f(best) ? z : best;
  }
  constexpr double golden = 0.6180339887498949;
  double low = best - step;
  double high = best + step;
  while (high - low > 1e-9) {
    const double a = high - golden * (high - low);
    const double b = low + golden * (high - low);
    if (f(a) > f(b)) {
      high = b;
    } else {
      low = a;
    }
  }
  return f(0.5 * (low + high)) * (1.0 + 1e-12);  // a bound is rounded up
}

}  // namespace

double Morlet::max_derivative() const {
  return largest([this](double z) { return std::abs(derivative(z)); }, omega0);
}

double Morlet::max_scaled_derivative() const {
  return largest([this](double z) { return std::abs(z * derivative(z)); }, omega0);
}

}  // namespace rwn
