// The `thesis` learning rates at one sample (eq. 4.35-4.124, E.1-E.24), inside the training loop.
#pragma once

#include "rwn/numerics/pack.hpp"
#include "rwn/kernels/structured_step.hpp"
#include "rwn/kernels/plant_gain.hpp"

namespace rwn::RWN_ISA {

RWN_INLINE double magnitude(double x) { return __builtin_fabs(x); }

/// Largest |dPhi/dm| (3.56), |dPhi/dd| (3.74) and |c/d| max|phi'| over the wavelets, times |w|.
struct FrictionBounds {
  Pack translation{0.0}, dilation{0.0}, recurrence{0.0}, steepest{0.0};

  RWN_INLINE void include(const ThesisBounds& t, Pack w, Pack m, Pack c, Pack inverse_d) {
    const Pack steep = abs(inverse_d);
    const Pack ratio = t.slope * abs(c) * steep;
    const Pack driven = abs(w) * steep / (1.0 - ratio);
    const Pack reach = t.printed ? (t.input + abs(c) + abs(m)) * steep : Pack(t.scaled_slope);
    translation = max(translation, driven * t.slope);
    dilation = max(dilation, driven * reach);
    recurrence = max(recurrence, ratio);
    steepest = max(steepest, steep);
  }
};

/// Raises the maxima of the driving signals by those of sample n-1 (tau comes from this step).
RWN_INLINE void see_signals(ThesisBounds& t, double x1, double x2, double u, double tau) {
  t.x1 = max(t.x1, magnitude(x1));
  t.x2 = max(t.x2, magnitude(x2));
  t.u = max(t.u, magnitude(u));
  t.tau = max(t.tau, magnitude(tau));
}

/// Counts the samples at which the bound has no meaning, and keeps the worst of each kind.
RWN_INLINE void see_health(ThesisBounds& t, const PlantGain& a, double recurrence, double steepest) {
  t.unstable += a.spectral_radius >= 1.0;
  t.defective += !(a.condition <= kDefectiveCondition);
  t.recurrent += recurrence >= 1.0;
  t.spectral_radius = max(t.spectral_radius, a.spectral_radius);
  t.condition = max(t.condition, a.condition);
  t.recurrence = max(t.recurrence, recurrence);
  t.steepest = max(t.steepest, steepest);
}

/// mu_g = 2 fraction / (largest bound)^2. The division happens only where a maximum rises, which is rare and which the
/// processor predicts, so that the bounds are off the critical path of the step.
RWN_INLINE void raise(ThesisBounds& t, int g, double bound) {
  if (bound > t.maximum[g]) {
    t.maximum[g] = bound;
    t.rate[g] = t.numerator[g] / (bound * bound);
  }
}

/// The rates of this sample: t.rate, or zeros where the bound has no meaning (those samples are counted).
RWN_INLINE const double* thesis_rates(ThesisBounds& t, const double* v, const PlantGain& a, const FrictionBounds& f,
                                      bool electrical, bool friction) {
  static constexpr double nothing[kStructuredGroups] = {};
  const double recurrence = friction ? largest(f.recurrence) : 0.0;
  see_health(t, a, recurrence, friction ? largest(f.steepest) : 0.0);
  const double gain = a.condition / (1.0 - a.spectral_radius);
  if (!(gain > 0.0 && gain < 1e300 && recurrence < 1.0)) return nothing;
  const double v1 = magnitude(v[0]), v2 = magnitude(v[1]), v3 = magnitude(v[2]), v4 = magnitude(v[3]);
  raise(t, kV1, gain * v2 * t.x1);                                   // 4.51
  raise(t, kV2, gain * (v3 * t.x2 + v1 * t.x1 + t.tau));             // 4.63
  raise(t, kV3, gain * ((t.misprint ? v3 : v2) * t.x2 + v4 * t.x1));  // 4.75, E2 = [v2; 0]
  if (electrical) {
    raise(t, kV4, gain * (v3 * t.x1 + t.u));  // E.11
    raise(t, kV5, gain * t.x2);               // E.23
  }
  if (friction) {
    const double net = gain * v2 * t.root_wavelets;
    const double translation = net * largest(f.translation);
    raise(t, kWeight, net * t.phi);                    // 4.87
    raise(t, kTranslation, translation);               // 4.99
    raise(t, kDilation, net * largest(f.dilation));    // 4.111
    raise(t, kFeedback, translation * t.phi);          // 4.123
  }
  return t.rate;
}

}  // namespace rwn::RWN_ISA
