// Sums of Mexican hats over one variable, which is what a wavelet network in a formula comes to: all of them at once in
// the processor's vectors, where the stack machine would take a dozen steps for each.
#pragma once

#include <cmath>
#include <type_traits>

#include "rwn/numerics/dual.hpp"
#include "rwn/numerics/pack.hpp"
#include "rwn/numerics/room.hpp"

namespace rwn {

inline constexpr int max_wavelets = 16;  // of one sum

/// sum_k w_k hat(z_k), hat(z) = (1 - z^2) exp(-z^2 / 2), z_k = a_k x + c_k, or a_k sin(f x) + b_k cos(f x) + c_k for a
/// frequency f that is not 0. w_k is factor_k, times an own parameter where parameter_k is not -1. What is not used is
/// 0.
struct WaveletSum {
  int over = 0;  // the variable x
  int count = 0;
  double frequency = 0.0;
  alignas(64) double a[max_wavelets] = {};
  alignas(64) double b[max_wavelets] = {};
  alignas(64) double c[max_wavelets] = {};
  double factor[max_wavelets] = {};
  int parameter[max_wavelets] = {};

  /// Whether no weight is a parameter.
  bool numeric() const {
    for (int k = 0; k < count; ++k) {
      if (parameter[k] >= 0) return false;
    }
    return true;
  }
};

/// The sum at x, with the slopes of x and, where they are of the same kind, of the own parameters p.
template <int N, class Isa, class P>
Dual<N, Isa> sum_at(const WaveletSum& sum, const Dual<N, Isa>& x, const P* p) {
  using RWN_ISA::load, RWN_ISA::Pack;
  const double f = sum.frequency, sine = f != 0.0 ? std::sin(f * x.v) : x.v,
               cosine = f != 0.0 ? std::cos(f * x.v) : 0.0;
  const double of_sine = f != 0.0 ? f * cosine : 1.0, of_cosine = f != 0.0 ? -f * sine : 0.0;
  alignas(64) Room<double, max_wavelets> weights, hats;
  for (int k = 0; k < max_wavelets; ++k) {
    const int own = k < sum.count ? sum.parameter[k] : -1;
    weights.numbers[k] = own < 0 ? sum.factor[k] : sum.factor[k] * p[own].v;
  }
  Pack value, slope;
  for (int k = 0; k < sum.count; k += RWN_ISA::width) {
    const Pack a = load(sum.a + k), b = load(sum.b + k), weight = load(weights.numbers + k);
    const Pack z = a * Pack(sine) + b * Pack(cosine) + load(sum.c + k), square = z * z;
    const Pack bell = exp(Pack(-0.5) * square), hat = (Pack(1.0) - square) * bell;
    store(hats.numbers + k, hat);
    value += weight * hat;
    slope += weight * z * (square - Pack(3.0)) * bell * (a * Pack(of_sine) + b * Pack(of_cosine));
  }
  Dual<N, Isa> y = x.chain(RWN_ISA::sum(value), RWN_ISA::sum(slope));
  if constexpr (std::is_same_v<P, Dual<N, Isa>>) {
    for (int k = 0; k < sum.count; ++k) {
      if (sum.parameter[k] >= 0) y.d += (sum.factor[k] * hats.numbers[k]) * p[sum.parameter[k]].d;
    }
  }
  return y;
}

}  // namespace rwn
