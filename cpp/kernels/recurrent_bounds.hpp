// The `thesis` learning rates of the recurrent network at one sample (eq. 3.31-3.89), inside the training loop.
#pragma once

#include "rwn/kernels/recurrent_step.hpp"
#include "rwn/numerics/pack.hpp"

namespace rwn::RWN_ISA {

/// Largest bounds of |dPhi/dm| (3.56) and |dPhi/dd| (3.74) over wavelets and inputs, times |w|; worst recurrence.
struct WaveletBounds {
  Pack translation{0.0}, dilation{0.0}, recurrence{0.0}, steepest{0.0};

  /// One vector of wavelets at one input, whose largest value so far is `input`.
  RWN_INLINE void include(const RecurrentBounds& t, double input, Pack w, Pack m, Pack c, Pack inverse_d) {
    const Pack steep = abs(inverse_d);
    const Pack ratio = t.slope * abs(c) * steep;
    const Pack driven = abs(w) * steep / (1.0 - ratio);
    const Pack reach = t.printed ? (input + abs(c) + abs(m)) * steep : Pack(t.scaled_slope);
    translation = max(translation, driven);
    dilation = max(dilation, driven * reach);
    recurrence = max(recurrence, ratio);
    steepest = max(steepest, steep);
  }
};

/// mu_g = 2 fraction / (largest bound)^2; the division happens only where a maximum rises.
RWN_INLINE void raise(RecurrentBounds& t, int g, double bound) {
  if (bound > t.maximum[g]) {
    t.maximum[g] = bound;
    t.rate[g] = t.numerator[g] / (bound * bound);
  }
}

/// Raises the largest input, so that the bounds of this sample know it.
RWN_INLINE double see_inputs(RecurrentBounds& t, const double* x, long inputs) {
  double largest_input = 0.0;
  for (long i = 0; i < inputs; ++i) {
    t.input[i] = max(t.input[i], __builtin_fabs(x[i]));
    largest_input = max(largest_input, t.input[i]);
  }
  return largest_input;
}

/// The rates of this sample into `rates`; those of m, d, c are 0 where their bounds have no meaning.
RWN_INLINE void thesis_rates(RecurrentBounds& t, double largest_input, const WaveletBounds& seen, double* rates) {
  const double recurrence = largest(seen.recurrence);
  ++t.samples;
  t.recurrent += !(recurrence < 1.0);
  t.recurrence = max(t.recurrence, recurrence);
  t.steepest = max(t.steepest, largest(seen.steepest));
  raise(t, kBias, 1.0);                                         // 3.33
  raise(t, kDirect, t.root_inputs * largest_input);             // 3.38
  raise(t, kOutput, t.root_wavelets * t.others * t.phi);        // 3.44
  const bool meaningful = recurrence < 1.0;
  if (meaningful) {
    const double root = t.root_wavelets * t.root_inputs * t.others;
    const double translation = root * t.slope * largest(seen.translation);
    raise(t, kShift, translation);                        // 3.57
    raise(t, kScale, root * largest(seen.dilation));      // 3.75
    raise(t, kLoop, translation * t.phi);                 // 3.88
  }
  for (int g = 0; g < kRecurrentGroups; ++g) rates[g] = meaningful || g < kShift ? t.rate[g] : 0.0;
}

}  // namespace rwn::RWN_ISA
