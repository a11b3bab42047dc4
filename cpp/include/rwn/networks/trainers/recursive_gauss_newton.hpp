#pragma once

#include "rwn/networks/online_training.hpp"

namespace rwn {

/// Recursive Gauss-Newton on the structured network in square-root form (Potter 1963; Bierman 1977, II.4): the
/// covariance of the parameters is S S^T, and with phi = dy/dtheta, f = S^T phi, alpha = lambda r + f^T f,
///   theta += S f e / alpha,  S = (S - S f f^T / (alpha + sqrt(alpha lambda r))) / sqrt(lambda).
/// With `follow_state` the state moves with its parameters, x += (dx/dtheta) dtheta: this is then the extended Kalman
/// filter of a plant with a known initial state and constant parameters.
struct RecursiveGaussNewton {
  double noise = 1e-3;            // standard deviation of the measured speed, r = noise^2
  double forgetting = 0.999;      // lambda per sample of the first cycle, 0 < lambda <= 1
  double forgetting_decay = 0.3;  // 1 - lambda is multiplied by this after every cycle, so that estimates come to rest
  double underweighting = 0.5;  // r + underweighting f^T f stands for r in the first cycle; shrinks as 1 - lambda does
  bool follow_state = true;
  int cycles = 5;
  int frozen_every = 0;

  struct Result {
    StructuredNetwork network;
    OnlineHistory history;
    Vector deviation;  // of every parameter, by the information of one frozen pass and the prior; 0 where it does not
                       // learn
  };
  /// `spread` (5 + 4 N_w): prior standard deviation of every parameter; 0 keeps it fixed. No step takes more than half
  /// of v2, v3, v4 or of a dilation, so that none of them changes sign; a step that was cut short leaves S as it was.
  /// A cycle after which the frozen error is larger is undone and tried again with ten times the underweighting.
  Result train(const StructuredNetwork& network, const StructuredSignals& signals, const VectorRef& spread) const;
};

}  // namespace rwn
