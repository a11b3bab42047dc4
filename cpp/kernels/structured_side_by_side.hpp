// Runs side by side, one per lane (SoA over runs): the latency of one run's chain is hidden behind the others. A
// wavelet's correction waits for the next sample, when its rows pass through the registers anyway.
#pragma once

#include "structured_run.hpp"

namespace rwn::RWN_ISA {

template <class W>
struct SideBySideRun : Run<W, Pack, 0> {
  using Base = Run<W, Pack, 0>;
  using Base::a11, Base::a12, Base::a21, Base::a22, Base::net, Base::tau, Base::v, Base::wavelet;
  Pack rates[kStructuredGroups];
  Pack waiting[4] = {0.0, 0.0, 0.0, 0.0};  // mu e of w, m, d, c, not yet applied

  RWN_INLINE SideBySideRun(StructuredBlock& b, W w) : Base(b, w) {
    for (int g = 0; g < kStructuredGroups; ++g) rates[g] = load(b.rates + g * width);
  }

  /// As Run::advance, after the correction that waits.
  RWN_INLINE void advance(double u, double speed) {
    NoBounds none;
    Base::plant();
    tau = Pack(0.0);
    for (long p = 0; p < net.size(); ++p) {
      for (int g = 0; g < 4; ++g) net.set(kTheta + g, p, corrected(g, p));
      tau += Base::wavelets(p, Pack(speed), none);
    }
    Base::linear_sensitivities(u);
    Base::move(u);  // before the second loop, which nothing waits for: it fills the wait for the error
    for (long p = 0; p < net.size(); ++p) Base::wavelet_sensitivities(p);
  }

  /// As Run::correct; the network's share waits.
  RWN_INLINE void correct(Pack error) {
    Pack unused1, unused2;
    Base::template correct_linear<0, 3>(error, rates, unused1, unused2);
    if (Base::electrical) Base::template correct_linear<3, 5>(error, rates, unused1, unused2);
    for (int g = 0; g < 4; ++g) waiting[g] = rates[kWeight + g] * error;
  }

  RWN_INLINE void save() {
    for (long p = 0; p < net.size(); ++p) {
      for (int g = 0; g < 4; ++g) net.set(kTheta + g, p, corrected(g, p));
    }
    Base::save();
  }

 private:
  RWN_INLINE Pack corrected(int g, long p) const { return net.get(kTheta + g, p) + waiting[g] * net.get(kPNet + g, p); }
};

}  // namespace rwn::RWN_ISA
