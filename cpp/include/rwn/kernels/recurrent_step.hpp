// The recurrent network's training step (thesis eq. 3.1-3.19) as compiled once per instruction set.
// Plain structs and function pointers only: this header is included by files built for different processors.
#pragma once

namespace rwn {

/// Parameter groups of the recurrent network, in the order of rates and of the flat parameter vector.
enum RecurrentGroup { kBias, kDirect, kOutput, kShift, kScale, kLoop, kRecurrentGroups };

/// Rows of a vector of wavelets: weight and product Phi_j (3.2); then for every input m d c, phi, V1-V3, the
/// derivatives by m d c, and the product of the factors before this input.
enum RecurrentRow { kWeightRow, kProduct, kOutputRows };
enum RecurrentInputRow { kShape = 0, kFactor = 3, kRecursion = 4, kSlopes = 7, kAhead = 10, kInputRows = 11 };

/// One run; the lanes are wavelets, padded to whole vectors. All pointers are 64-byte aligned.
struct RecurrentBlock {
  double* linear;   // b, a (N_i), then the inputs of the sample, which are dy/da
  double* network;  // [vector][row][lane], rows as above, kOutputRows + N_i kInputRows
  long vectors, inputs;
  int wavelet;  // index in rwn::Wavelets
  double omega0;
  double rates[kRecurrentGroups];
};

/// One cycle: inputs[n * stride] are those of sample n.
struct RecurrentCycle {
  const double* inputs;
  long stride;
  const double* output;
  long samples;
};

/// Running maxima and bounds of the `thesis` rule (eq. 3.31-3.89).
struct RecurrentBounds {
  double numerator[kRecurrentGroups];  // 2 * fraction; 0 for a group that does not learn
  double maximum[kRecurrentGroups];    // largest bound seen
  double rate[kRecurrentGroups];       // numerator / maximum^2; 0 before anything was seen
  double* input;                       // largest |x_i| seen (N_i)
  double phi, slope, scaled_slope;     // bounds of |phi|, |phi'|, |z phi'|; the last only where `printed` is false
  bool printed;                        // |z| bounded by (x + |c| + |m|)/|d| (3.73)
  double others;                       // bound of the product of the other factors, phi^(N_i - 1)
  double root_inputs, root_wavelets;
  double recurrence, steepest;  // worst seen: |c/d| max|phi'|, 1/|d|
  long recurrent, samples;      // samples with recurrence >= 1, at which m, d, c do not learn; all samples
};

/// The kernels of one instruction set.
struct RecurrentKernels {
  int width;  // doubles in a vector
  /// Output and sensitivities of the next sample with the parameters as they stand; then theta += rates e dy/dtheta.
  double (*advance)(RecurrentBlock&, const double* x);
  void (*correct)(RecurrentBlock&, double error);
  /// One cycle without learning: output[n] = y(n).
  void (*simulate)(RecurrentBlock&, const RecurrentCycle&, double* output);
  /// One cycle of training, with the rates of the block or with the `thesis` rule at every sample; the sum of squared
  /// errors.
  double (*train)(RecurrentBlock&, const RecurrentCycle&);
  double (*train_thesis)(RecurrentBlock&, const RecurrentCycle&, RecurrentBounds&);
};

/// The kernels for this processor.
const RecurrentKernels& recurrent_kernels();

}  // namespace rwn
