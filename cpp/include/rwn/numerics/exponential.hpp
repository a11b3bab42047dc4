// The matrix functions of exponential integrators, phi_0(Z) = e^Z and phi_k(Z) = (phi_{k-1}(Z) - 1/(k-1)!) / Z,
// for small matrices of any scalar, by scaling and squaring (Hochbruck, Ostermann, Acta Numerica 2010): exact for
// singular and defective Z, where formulas with eigenvalues fail.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "rwn/numerics/dual.hpp"

namespace rwn {

template <class S, int n>
using SmallMatrix = std::array<S, static_cast<std::size_t>(n* n)>;
template <class S, int n>
using SmallVector = std::array<S, static_cast<std::size_t>(n)>;

template <class S, int n>
SmallMatrix<S, n> product(const SmallMatrix<S, n>& a, const SmallMatrix<S, n>& b) {
  SmallMatrix<S, n> c;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      S sum = a[i * n] * b[j];
      for (std::size_t k = 1; k < n; ++k) add_product(sum, a[i * n + k], b[k * n + j]);
      c[i * n + j] = sum;
    }
  }
  return c;
}

/// y += a x
template <class S, int n>
RWN_INLINE void add_product(SmallVector<S, n>& y, const SmallMatrix<S, n>& a, const SmallVector<S, n>& x) {
  for (std::size_t i = 0; i < n; ++i) {
    S sum = y[i];
    for (std::size_t j = 0; j < n; ++j) add_product(sum, a[i * n + j], x[j]);
    y[i] = sum;
  }
}

/// alpha a + beta b
template <class S, int n>
SmallMatrix<S, n> combine(double alpha, const SmallMatrix<S, n>& a, double beta, const SmallMatrix<S, n>& b) {
  SmallMatrix<S, n> c;
  for (std::size_t i = 0; i < c.size(); ++i) c[i] = alpha * a[i] + beta * b[i];
  return c;
}

template <class S, int n>
struct PhiFunctions {
  SmallMatrix<S, n> p0, p1, p2, p3;
};

/// a z + b I
template <class S, int n>
SmallMatrix<S, n> horner(const SmallMatrix<S, n>& a, const SmallMatrix<S, n>& z, double b) {
  SmallMatrix<S, n> c = product<S, n>(a, z);
  for (std::size_t i = 0; i < n; ++i) c[i * n + i] += S(b);
  return c;
}

/// Takes them from z to 2 z.
template <class S, int n>
void double_argument(PhiFunctions<S, n>& f) {
  f.p3 = combine<S, n>(0.125, combine<S, n>(1.0, product<S, n>(f.p1, f.p2), 1.0, f.p2), 0.25, f.p3);
  f.p2 = combine<S, n>(0.25, product<S, n>(f.p1, f.p1), 0.5, f.p2);
  f.p1 = combine<S, n>(0.5, product<S, n>(f.p0, f.p1), 0.5, f.p1);
  f.p0 = product<S, n>(f.p0, f.p0);
}

template <class S, int n>
PhiFunctions<S, n> phi_functions(SmallMatrix<S, n> z) {
  double size = 0.0;
  for (const S& entry : z) size = std::max(size, std::abs(value_of(entry)));
  if (!std::isfinite(size)) size = 0.0;  // nothing finite comes of it
  int doublings = 0;
  for (; size * n > 0.5; size *= 0.5) ++doublings;
  for (S& entry : z) entry *= std::ldexp(1.0, -doublings);

  constexpr double inverse_factorial[] = {1.0 / 6,          1.0 / 24,         1.0 / 120,          1.0 / 720,
                                          1.0 / 5040,       1.0 / 40320,      1.0 / 362880,       1.0 / 3628800,
                                          1.0 / 39916800.0, 1.0 / 479001600., 1.0 / 6227020800.0, 1.0 / 87178291200.0};
  // the series by powers of z^3, with polynomials of z as coefficients (Paterson, Stockmeyer 1973): 5 products, not 11
  const SmallMatrix<S, n> z2 = product<S, n>(z, z), z3 = product<S, n>(z2, z);
  const auto coefficient = [&](int k) {
    SmallMatrix<S, n> c = combine<S, n>(inverse_factorial[k + 1], z, inverse_factorial[k + 2], z2);
    for (std::size_t i = 0; i < n; ++i) c[i * n + i] += S(inverse_factorial[k]);
    return c;
  };
  PhiFunctions<S, n> f;
  f.p3 = coefficient(9);
  for (int k = 6; k >= 0; k -= 3) f.p3 = combine<S, n>(1.0, product<S, n>(f.p3, z3), 1.0, coefficient(k));
  f.p2 = horner<S, n>(f.p3, z, 0.5);
  f.p1 = horner<S, n>(f.p2, z, 1.0);
  f.p0 = horner<S, n>(f.p1, z, 1.0);
  for (; doublings > 0; --doublings) double_argument<S, n>(f);
  return f;
}

}  // namespace rwn
