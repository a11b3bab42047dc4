// Residual and exact Jacobian of the structured network over one recording, for batch least squares.
#pragma once

#include <vector>

#include "rwn/networks/trainers/structured_levenberg_marquardt.hpp"

namespace rwn {

/// Residual e = y - x1 and Jacobian dx1/dtheta (n, learning parameters) of a network; with a measured current the
/// weighted residual and Jacobian of the current stand below.
class StructuredProblem {
 public:
  StructuredProblem(const StructuredMeasurements& data, const std::vector<bool>& learn, bool gauge, double ridge);

  const std::vector<Eigen::Index>& which() const { return which_; }  // parameters that learn
  const RowMatrix& jacobian() const { return jacobian_; }
  const Vector& residual() const { return residual_; }
  double slope() const { return slope_; }
  /// What the ridge adds to the normal equations: its curvature by every learning parameter, and its gradient.
  const Vector& curvature() const { return curvature_; }
  const Vector& gradient() const { return gradient_; }

  /// Takes over the residual and the Jacobian of another point.
  void take(StructuredProblem& other);
  /// Sum of squared errors with the ridge, or infinity where the plant is not stable.
  double evaluate(const StructuredNetwork& net);

 private:
  template <class Feed>
  void filter(const StructuredNetwork& net, Feed& feed, const Eigen::Matrix2d& a);
  double restrain(const StructuredNetwork& net);
  void keep(Eigen::Index n, const Eigen::Vector2d& x, const Eigen::RowVectorXd& P, const Eigen::RowVectorXd& Q);

  const StructuredMeasurements& data_;
  const StructuredSignals& signals_;
  bool gauge_;
  Eigen::Index outputs_;
  std::vector<Eigen::Index> which_;
  RowMatrix jacobian_;
  Vector residual_;
  double pull_;
  Vector curvature_, gradient_;
  double slope_ = 0.0;
};

}  // namespace rwn
