#pragma once

#include "rwn/networks/training.hpp"

namespace rwn {

/// Recursive Gauss-Newton after every pattern, square-root form: the covariance is P = S S^T and S is updated by
/// Potter's formula, so P stays symmetric and positive whatever the rounding. The outputs of a pattern are taken one by
/// one.
struct PatternGaussNewton {
  static constexpr std::string_view name = "pattern-gauss-newton";
  double noise = 1e-2;         // standard deviation of the errors, in units of the outputs
  double weight_prior = 1.0;   // of b, a and w about their start
  double shape_prior = 0.1;    // of translations and dilations, in units of each dilation
  double forgetting =
      0.999;  // factor on old information per pattern, in (0, 1]; it was gathered about other parameters
  int iterations = 20;         // passes over the patterns
  double target = 0.0;
  double stall = 1e-12;

  /// History: as PatternDescent's, the errors met just before each update; Training::frozen_mse is of the frozen
  /// network.
  /// \param x (patterns, inputs)  \param y (patterns, outputs)
  Training train(ConventionalNetwork network, const RowMatrixRef& x, const RowMatrixRef& y) const;
};

}  // namespace rwn
