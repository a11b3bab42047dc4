// The structured network's training step (thesis eq. 4.6-4.29) as compiled once per instruction set.
// Plain structs and function pointers only: this header is included by files built for different processors.
#pragma once

#include "rwn/kernels/plant_gain.hpp"

namespace rwn {

/// Parameter groups of the structured network, in the order of rates and of the flat parameter vector.
enum StructuredGroup { kV1, kV2, kV3, kV4, kV5, kWeight, kTranslation, kDilation, kFeedback, kStructuredGroups };

/// Rows of the linear block: parameters, state, sensitivities of x1 (P) and of x2 (Q), last friction torque.
enum LinearRow { kV = 0, kX1 = 5, kX2 = 6, kP = 7, kQ = 12, kTau = 17, kLinearRows = 18 };

/// Rows of the network block: parameters w m d c, phi, V1-V3, P and Q of w m d c, and scratch within a step.
enum NetworkRow { kTheta = 0, kPhi = 4, kVee = 5, kPNet = 8, kQNet = 12, kBefore = 16, kZ, kSlope, kNetworkRows };

/// One run, or `width` runs side by side. All pointers are 64-byte aligned. The network block is [vector][row][lane].
/// One run: the lanes are wavelets, padded to whole vectors; a linear row is one number.
/// Side by side: a vector is one wavelet, lane k belongs to run k; a linear row is one vector.
struct StructuredBlock {
  double* linear;
  double* network;
  long vectors;           // vectors of wavelets
  int wavelet;            // index in rwn::Wavelets
  double omega0;
  double* rates;          // learning rate of each group: [group], side by side [group][lane]
  bool electrical;        // sensitivities of v4 and v5 are wanted
  bool friction;          // sensitivities of the network's parameters are wanted
  bool carry;             // after each update the state follows: x += dx/dtheta * dtheta
};

/// One training cycle: sample n is predicted from input[n-1], speed[n-1] and compared with speed[n].
struct StructuredCycle {
  const double* input;
  const double* speed;
  long samples;
  double* squared_error;  // sum over samples 1..n-1 [lane], written
};

/// Running maxima and bounds of the `thesis` rule (eq. 4.35-4.124, E.1-E.24).
struct ThesisBounds {
  double numerator[kStructuredGroups];  // 2 * fraction; 0 for a group that does not learn
  double maximum[kStructuredGroups];    // largest bound seen
  double rate[kStructuredGroups];       // numerator / maximum^2; 0 before anything was seen
  double phi, slope, scaled_slope;      // bounds of |phi|, |phi'|, |z phi'|; the last only where `printed` is false
  bool printed;                         // |z| bounded by (u + |c| + |m|)/|d| (3.73)
  bool misprint;                        // |v3| where 4.66-4.75 need |v2|
  PlantGain (*decompose)(double a11, double a12, double a21, double a22);  // null: the closed form
  double root_wavelets;                 // sqrt(N_w)
  double x1, x2, u, tau, input;         // maxima of the driving signals
  double spectral_radius, condition, recurrence, steepest;  // worst seen: |c/d| max|phi'|, 1/|d|
  long unstable, defective, recurrent;  // samples at which the bound had no meaning, and that were not learned from
};

inline constexpr double kDefectiveCondition = 1e8;

/// The kernels of one instruction set.
struct StructuredKernels {
  int width;  // doubles in a vector
  /// State and sensitivities of the next sample with the parameters as they stand; then theta += rates e P.
  void (*advance)(StructuredBlock&, double input, double speed);
  void (*correct)(StructuredBlock&, double error);
  /// One cycle without learning: output[n] = x1(n).
  void (*simulate)(StructuredBlock&, const StructuredCycle&, double* output);
  /// One cycle of training: rates held, the `thesis` rule at every sample, rates held for `width` runs side by side.
  void (*train)(StructuredBlock&, const StructuredCycle&);
  void (*train_thesis)(StructuredBlock&, const StructuredCycle&, ThesisBounds&);
  void (*train_side_by_side)(StructuredBlock&, const StructuredCycle&);
};

/// The kernels for this processor.
const StructuredKernels& structured_kernels();

}  // namespace rwn
