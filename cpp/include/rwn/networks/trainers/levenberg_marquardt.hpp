#pragma once

#include "rwn/networks/training.hpp"

namespace rwn {

/// Levenberg-Marquardt on all parameters (2.22-2.24): dtheta = (J^T J + mu I)^-1 J^T e; mu is divided by beta after a
/// step that lowers the sum of squares, multiplied by beta after one that does not.
struct LevenbergMarquardt {
  static constexpr std::string_view name = "levenberg-marquardt";
  double mu = 0.1;
  double beta = 2.0;
  int iterations = 100;
  double target = 0.0;
  double stall = 1e-12;

  /// History: the MSE before the first and after every iteration (one Jacobian each).
  Training train(ConventionalNetwork network, const Patterns& patterns) const;
};

}  // namespace rwn
