// A random structured network of the thesis's motor and a recording, for the tests of per-sample training.
#pragma once

#include <cmath>
#include <random>

#include "rwn/networks/structured_network.hpp"

namespace rwn::testing {

inline StructuredNetwork network(Eigen::Index wavelets, unsigned seed, const Wavelet& wavelet = Wavelet()) {
  std::mt19937 rng(seed);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  Vector theta(5 + 4 * wavelets);
  theta.head(5) << 0.06, 1e-4 / 1.8e-4, 0.055, 0.125, 0.95;
  for (Eigen::Index j = 0; j < wavelets; ++j) {
    theta[5 + j] = 0.05 * u(rng);
    theta[5 + wavelets + j] = 1.5 * u(rng);
    theta[5 + 2 * wavelets + j] = 0.6 + 0.4 * u(rng);
    theta[5 + 3 * wavelets + j] = 0.1 * u(rng) / wavelet.max_derivative();
  }
  return {theta, wavelet};
}

struct Recording {
  Vector input, speed;
  explicit Recording(Eigen::Index n) : input(n), speed(n) {
    for (Eigen::Index k = 0; k < n; ++k) {
      input[k] = std::sin(0.002 * static_cast<double>(k));
      speed[k] = 1.3 * std::sin(0.002 * static_cast<double>(k) - 0.1);
    }
  }
  StructuredSignals signals() const { return {input, speed}; }
};

}  // namespace rwn::testing
