#pragma once

#include "rwn/networks/conventional_network.hpp"

namespace rwn {

/// Translations and dilations of a network, (wavelets, inputs) each.
struct Shapes {
  RowMatrix m, d;
};

/// Smallest and largest value of every input. \throws std::invalid_argument if an input is constant.
struct Domain {
  Eigen::RowVectorXd low, high;
  explicit Domain(const RowMatrixRef& x);
};

}  // namespace rwn
