#pragma once

#include "rwn/networks/training.hpp"

namespace rwn {

/// Levenberg-Marquardt on translations and dilations only; b, a and w are the least-squares solution at every step
/// (Golub & Pereyra 1973, with the Jacobian of Kaufman 1975). The damping is scaled by the Jacobian's columns. A
/// wavelet narrower than the distance of the patterns fits one pattern and says nothing between them: dilations are
/// kept wider.
struct VariableProjection {
  static constexpr std::string_view name = "variable-projection";
  double mu = 1e-3;
  double beta = 4.0;
  double resolution = 1.0;  // dilations stay above this many mean distances of the patterns and below 4 ranges; 0: free
  int iterations = 100;
  double target = 0.0;
  double stall = 1e-12;

  /// History: the MSE before the first iteration (with b, a, w already solved for) and after every one.
  Training train(ConventionalNetwork network, const Patterns& patterns) const;
};

}  // namespace rwn
