// Residual and exact Jacobian of the structured network over one recording, for batch least squares.
#pragma once

#include <vector>

#include "rwn/trainers/structured_levenberg_marquardt.hpp"

namespace rwn {

/// Friction torque of a network along a measured speed (n) and its derivative by w, m, d, c (n, 4 N_w), by 3.16-3.18.
struct FrictionTorque {
  Vector value;
  RowMatrix slope;

  FrictionTorque(const StructuredNetwork& net, const VectorRef& speed);
  /// Takes the part along the measured speed out of the torque and of its derivatives; returns the slope of the torque.
  double project(const VectorRef& speed);
};

/// Residual e = y - x1 and Jacobian dx1/dtheta (n, learning parameters) of a network; with a measured current the
/// weighted residual and Jacobian of the current stand below.
class StructuredProblem {
 public:
  StructuredProblem(const StructuredMeasurements& data, const std::vector<bool>& learn, bool gauge);

  const std::vector<Eigen::Index>& which() const { return which_; }  // parameters that learn
  const RowMatrix& jacobian() const { return jacobian_; }
  const Vector& residual() const { return residual_; }
  double slope() const { return slope_; }

  /// Takes over the residual and the Jacobian of another point.
  void take(StructuredProblem& other);
  /// Sum of squared errors, or infinity where the plant is not stable.
  double evaluate(const StructuredNetwork& net);

 private:
  void filter(const StructuredNetwork& net, const FrictionTorque& torque, const Eigen::Matrix2d& a);
  void keep(Eigen::Index n, const Eigen::Vector2d& x, const Eigen::RowVectorXd& P, const Eigen::RowVectorXd& Q);

  const StructuredMeasurements& data_;
  const StructuredSignals& signals_;
  bool gauge_;
  Eigen::Index outputs_;
  std::vector<Eigen::Index> which_;
  RowMatrix jacobian_;
  Vector residual_;
  double slope_ = 0.0;
};

}  // namespace rwn
