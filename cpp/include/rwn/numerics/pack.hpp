// A vector of doubles as wide as the instruction set that the including file is compiled for, with exp, sin and cos.
// GCC vector extensions only: no intrinsics, no -ffast-math (the rounding trick below would not survive it).
#pragma once

#include "rwn/numerics/vectors.hpp"

#ifndef RWN_ISA
#define RWN_ISA core  // files outside cpp/kernels, which are compiled once
#endif

namespace rwn::RWN_ISA {

inline constexpr int width = RWN_VECTOR_WIDTH;

using Vector [[gnu::vector_size(width * sizeof(double)), gnu::may_alias]] = double;
using Bits [[gnu::vector_size(width * sizeof(double))]] = long long;

struct Pack {
  Vector v;
  RWN_INLINE Pack() : v{} {}
  RWN_INLINE Pack(Vector x) : v(x) {}            // NOLINT: implicit, so that formulas read as formulas
  RWN_INLINE Pack(double x) : v(x - Vector{}) {}  // NOLINT: broadcast; x - 0 keeps the sign of a zero
};

RWN_INLINE Pack load(const double* p) { return *reinterpret_cast<const Vector*>(p); }
RWN_INLINE void store(double* p, Pack a) { *reinterpret_cast<Vector*>(p) = a.v; }

RWN_INLINE Pack operator+(Pack a, Pack b) { return a.v + b.v; }
RWN_INLINE Pack operator-(Pack a, Pack b) { return a.v - b.v; }
RWN_INLINE Pack operator*(Pack a, Pack b) { return a.v * b.v; }
RWN_INLINE Pack operator/(Pack a, Pack b) { return a.v / b.v; }
RWN_INLINE Pack operator-(Pack a) { return -a.v; }
RWN_INLINE Pack& operator+=(Pack& a, Pack b) { return a = a + b; }

RWN_INLINE Pack select(Bits mask, Pack a, Pack b) { return mask ? a.v : b.v; }
RWN_INLINE Pack max(Pack a, Pack b) { return a.v > b.v ? a.v : b.v; }
RWN_INLINE Pack abs(Pack a) { return reinterpret_cast<Vector>(reinterpret_cast<Bits>(a.v) & 0x7fffffffffffffffLL); }
RWN_INLINE double max(double a, double b) { return a > b ? a : b; }

/// Folds the lanes by halves with a commutative operation.
template <class Fold, int lanes = width>
RWN_INLINE double fold(Pack a, Fold op) {
  if constexpr (lanes == 8) {
    const auto four = op(__builtin_shufflevector(a.v, a.v, 0, 1, 2, 3),
                         __builtin_shufflevector(a.v, a.v, lanes - 4, lanes - 3, lanes - 2, lanes - 1));
    const auto two = op(__builtin_shufflevector(four, four, 0, 1), __builtin_shufflevector(four, four, 2, 3));
    return op(two[0], two[1]);
  } else if constexpr (lanes == 4) {
    const auto two =
        op(__builtin_shufflevector(a.v, a.v, 0, 1), __builtin_shufflevector(a.v, a.v, lanes - 2, lanes - 1));
    return op(two[0], two[1]);
  } else {
    return op(a.v[0], a.v[1]);
  }
}
RWN_INLINE double sum(Pack a) {
  return fold(a, [](auto x, auto y) [[gnu::always_inline]] { return x + y; });
}
RWN_INLINE double largest(Pack a) {
  return fold(a, [](auto x, auto y) [[gnu::always_inline]] { return x > y ? x : y; });
}

/// exp to 2 ulp for x <= 700; exactly 0 below -700 (where wavelets vanish anyway), NaN stays NaN.
/// x = k ln 2 + r, |r| <= ln 2 / 2; exp(r) = 1 + r + r^2 q(r), q by Chebyshev interpolation (relative error 1.7e-17).
RWN_INLINE Pack exp(Pack x) {
  constexpr double shift = 6755399441055744.0;  // 1.5 * 2^52: adding it leaves the nearest integer in the low bits
  const Vector t = x.v * 1.4426950408889634074 + shift;
  const Vector k = t - shift;
  const Vector r = (x.v - k * 0.69314718036912381649) - k * 1.9082149288430702572e-10;
  const Vector r2 = r * r;
  const Vector r4 = r2 * r2;
  const Vector q01 = 0.50000000000000010221 + r * 0.16666666666666667453;
  const Vector q23 = 0.041666666666624127873 + r * 0.0083333333333300618325;
  const Vector q45 = 0.0013888888917213716901 + r * 0.00019841269863053616878;
  const Vector q67 = 2.4801521295954375131e-5 + r * 2.7557268459997064772e-6;
  const Vector q89 = 2.7620088445409748161e-7 + r * 2.5100385495510319078e-8;
  const Vector q = (q01 + r2 * q23) + r4 * ((q45 + r2 * q67) + r4 * q89);
  const Vector power = reinterpret_cast<Vector>((reinterpret_cast<Bits>(t) + 1023) << 52);
  const Vector y = power + power * (r + r2 * q);
  return x.v < -700.0 ? Vector{} : y;
}

/// sin and cos to 2 ulp of 1 for |x| < 1e5; 0 and 1 beyond, where exp(-z^2/2) beside them has vanished.
struct SinCos {
  Pack sin, cos;
};
RWN_INLINE SinCos sin_cos(Pack a) {
  constexpr double shift = 6755399441055744.0;
  const Vector x = abs(a).v < 1e5 ? a.v : Vector{};
  const Vector t = x * 0.63661977236758134308 + shift;
  const Vector k = t - shift;
  const Vector r = ((x - k * 1.5707963267341256142) - k * 6.0771005063039659766e-11) - k * 2.0222662487959507324e-21;
  const Vector s = r * r;
  const Vector p =
      -0.16666666666666664621 +
      s * (0.0083333333333309461029 +
           s * (-0.00019841269836754970014 +
                s * (2.755731610068302914e-6 + s * (-2.5051131455427947391e-8 + s * 1.5918101230274120348e-10))));
  const Vector c =
      0.041666666666666665387 +
      s * (-0.0013888888888887395746 +
           s * (2.4801587298763433164e-5 +
                s * (-2.7557317270560324065e-7 + s * (2.0876146024689746601e-9 - s * 1.1382614868556324576e-11))));
  const Vector sine = r + r * s * p;
  const Vector cosine = (1.0 - 0.5 * s) + s * s * c;
  const Bits quadrant = reinterpret_cast<Bits>(t);
  const Bits odd = (quadrant & 1) == 1;
  const Bits sine_negative = (quadrant & 2) == 2;
  const Bits cosine_negative = ((quadrant + 1) & 2) == 2;
  const Vector sn = odd ? cosine : sine;
  const Vector cs = odd ? sine : cosine;
  return {sine_negative ? -sn : sn, cosine_negative ? -cs : cs};
}
RWN_INLINE Pack sin(Pack a) { return sin_cos(a).sin; }
RWN_INLINE Pack cos(Pack a) { return sin_cos(a).cos; }

}  // namespace rwn::RWN_ISA
