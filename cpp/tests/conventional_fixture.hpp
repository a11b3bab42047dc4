// Random networks and patterns for tests.
#pragma once

#include <random>

#include "rwn/networks/conventional_network.hpp"

namespace rwn::testing {

inline RowMatrix random_matrix(int rows, int columns, std::mt19937& random) {
  std::normal_distribution<double> normal;
  return RowMatrix::NullaryExpr(rows, columns, [&] { return normal(random); });
}

/// Weights and translations of unit size, dilations between 0.5 and 1.5.
inline ConventionalNetwork random_network(const Wavelet& wavelet, const ConventionalShape& shape, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> dilation(0.5, 1.5);
  Eigen::VectorXd theta = random_matrix(shape.size(), 1, random);
  theta.tail(shape.wavelets * shape.inputs) =
      Eigen::VectorXd::NullaryExpr(shape.wavelets * shape.inputs, [&] { return dilation(random); });
  return {wavelet, shape, theta};
}

}  // namespace rwn::testing
