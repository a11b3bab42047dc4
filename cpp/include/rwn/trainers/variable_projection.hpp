#pragma once

#include "rwn/training.hpp"

namespace rwn {

/// Levenberg-Marquardt on translations and dilations only; b, a and w are the least-squares solution at every step
/// (Golub & Pereyra 1973, with the Jacobian of Kaufman 1975). The damping is scaled by the Jacobian's columns.
struct VariableProjection {
  static constexpr std::string_view name = "variable-projection";
  double mu = 1e-3;
  double beta = 4.0;
  int iterations = 100;
  double target = 0.0;
  double stall = 1e-12;

  /// History: the MSE before the first iteration (with b, a, w already solved for) and after every one.
  Training train(ConventionalNetwork network, const Patterns& patterns) const;
};

}  // namespace rwn
