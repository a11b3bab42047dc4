#pragma once

#include "rwn/networks/conventional_network.hpp"

namespace rwn {

/// b and a of every output by least squares on [1, x] (2.7), the smallest solution if x is rank deficient.
/// \return (1 + inputs, outputs): first row b, then a transposed
Eigen::MatrixXd least_squares(const RowMatrixRef& x, const RowMatrixRef& y);

}  // namespace rwn
