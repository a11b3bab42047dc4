#pragma once

#include "rwn/networks/training.hpp"

namespace rwn {

/// Steepest descent with momentum (2.20), updating after every pattern in the order given: the thesis's online
/// training.
struct PatternDescent {
  static constexpr std::string_view name = "pattern-descent";
  double rate = 0.1;
  double momentum = 0.6;
  double shape_momentum = 0.6;  // of translations and dilations
  int iterations = 1000;        // passes over the patterns
  double target = 0.0;
  double stall = 1e-12;

  /// History: the mean over each pass of the squared errors met just before each update. It is a tracking error and can
  /// be far below the error of the frozen network, which Training::frozen_mse holds.
  /// \param x (patterns, inputs)  \param y (patterns, outputs)
  Training train(ConventionalNetwork network, const RowMatrixRef& x, const RowMatrixRef& y) const;
};

}  // namespace rwn
