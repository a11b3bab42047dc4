#include "rwn/networks/initialisation/least_squares.hpp"

#include <Eigen/QR>

namespace rwn {

Eigen::MatrixXd least_squares(const RowMatrixRef& x, const RowMatrixRef& y) {
  Eigen::MatrixXd regressors(x.rows(), 1 + x.cols());
  regressors << Eigen::VectorXd::Ones(x.rows()), x;
  return regressors.completeOrthogonalDecomposition().solve(y);
}

}  // namespace rwn
