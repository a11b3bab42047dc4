#include "rwn/fit/innovations.hpp"

#include <algorithm>
#include <cmath>

namespace rwn {
namespace {

/// Predictors of all orders up to that of a noise, by Durbin's recursion.
struct Predictors {
  explicit Predictors(const std::vector<double>& reflection)
      : order(reflection.size()), weights(order + 1), gain(order + 1, 1.0) {
    for (std::size_t i = 0; i < order; ++i) {
      const double r = reflection[i];
      weights[i + 1].resize(i + 1);
      for (std::size_t j = 0; j < i; ++j) weights[i + 1][j] = weights[i][j] - r * weights[i][i - 1 - j];
      weights[i + 1][i] = r;
    }
    for (std::size_t i = order; i-- > 0;) gain[i] = gain[i + 1] * std::sqrt(1.0 - reflection[i] * reflection[i]);
  }

  std::size_t order;
  std::vector<std::vector<double>> weights;  // row i: of the i errors before, the latest first
  std::vector<double> gain;  // what the error of that prediction is scaled by to have the variance of the last
};

}  // namespace

void innovations(std::span<double> errors, const std::vector<double>& reflection, std::size_t restart,
                 std::span<double> slopes) {
  if (reflection.empty()) return;
  const std::size_t n = errors.size(), p = n > 0 ? slopes.size() / n : 0;
  const Predictors of(reflection);
  std::vector<std::size_t> places;  // of the errors since the start, NaN left out
  places.reserve(n);
  const auto replace = [&] {
    for (std::size_t i = places.size(); i-- > 0;) {  // from the end: those before are still as they were
      const std::size_t order = std::min(i, of.order), k = places[i];
      double* slope = slopes.data() + k * p;
      for (std::size_t j = 0; j < order; ++j) {
        const double weight = of.weights[order][j];
        const std::size_t before = places[i - 1 - j];
        errors[k] -= weight * errors[before];
        for (std::size_t c = 0; c < p; ++c) slope[c] -= weight * slopes[before * p + c];
      }
      if (order == of.order) continue;
      errors[k] *= of.gain[order];
      for (std::size_t c = 0; c < p; ++c) slope[c] *= of.gain[order];
    }
    places.clear();
  };
  for (std::size_t k = 0; k < n; ++k) {
    if (restart > 0 && k % restart == 0) replace();
    if (!std::isnan(errors[k])) places.push_back(k);
  }
  replace();
}

}  // namespace rwn
