#pragma once

#include "rwn/networks/training.hpp"

namespace rwn {

/// Steepest descent with momentum (2.20) on the mean over patterns of (2.12): the sum, as printed, diverges at every
/// rate of the thesis's tables (docs/errata.md).
struct GradientDescent {
  static constexpr std::string_view name = "gradient-descent";
  double rate = 0.1;
  double momentum = 0.6;
  int iterations = 10000;
  double target = 0.0;
  double stall = 1e-12;

  /// History: the MSE before the first and after every update.
  Training train(ConventionalNetwork network, const Patterns& patterns) const;
};

}  // namespace rwn
