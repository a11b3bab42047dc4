// Hot loops of the conventional wavelet network, on plain pointers; every array is padded and aligned (aligned.hpp).
#pragma once

namespace rwn {

/// Parameters of a network and its sizes. Arrays are row-major: a (outputs, inputs), w (outputs, wavelets),
/// m and d (wavelets, inputs).
struct ConventionalView {
  int wavelet;  // index in Wavelets
  double omega0;
  int inputs, wavelets, outputs;
  const double *b, *a, *w, *m, *d;
};

/// Patterns lie along the lanes: x (inputs, padded), y (outputs, padded), mask (padded) is 1 for a pattern, 0 for
/// padding.
struct PatternsView {
  int count, padded;
  const double *x, *y, *mask;
};

/// What a pass over all patterns leaves behind: phi (wavelets, padded), slope = dPhi_j/dz_ji (wavelets, inputs,
/// padded), error (outputs, padded), row (inputs, lanes) is scratch.
struct BatchView {
  double *phi, *slope, *error, *row;
};

/// State of per-pattern descent, wavelets along the lanes: b (outputs), a (outputs, inputs), w (outputs, padded),
/// m and d (inputs, padded); step_* is the last step of each.
struct DescentView {
  int wavelet;
  double omega0;
  int inputs, wavelets, outputs, padded;
  double *b, *a, *w, *m, *d;
  double *step_b, *step_a, *step_w, *step_m, *step_d;
  double *z, *phi, *slope, *error;  // (inputs, padded + lanes), (padded), (inputs, padded), (outputs)
  const double* mask;               // (padded) 1 for a wavelet, 0 for padding
  double rate, momentum, shape_momentum;
};

struct ConventionalKernels {
  /// Fills phi, slope and error = y - yhat; returns the sum of squared errors.
  double (*evaluate)(const ConventionalView&, const PatternsView&, const BatchView&);
  /// g = sum over patterns and outputs of error * dyhat/dtheta, in the order b, a, w, m, d.
  void (*gradient)(const ConventionalView&, const PatternsView&, const BatchView&, double* g);
  /// One pass with an update after every pattern (x and y time-first); returns the sum of squared errors met on the
  /// way.
  double (*descend)(const DescentView&, int count, const double* x, const double* y);
};

/// The kernels for this processor.
const ConventionalKernels& conventional_kernels();

}  // namespace rwn
