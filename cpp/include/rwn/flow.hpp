// One linear system over one length: its Taylor series, which costs a few products of matrix and vector where the
// functions of rwn/exponential.hpp cost products of matrices.
#pragma once

#include "rwn/exponential.hpp"

namespace rwn {

/// f(t) = constant + linear (t/h) + quadratic (t/h)^2 / 2 over a length h.
template <class S, int n>
struct Flow {
  SmallVector<S, n> constant{}, linear{}, quadratic{};
};

/// Greatest row sum.
template <class S, int n>
double norm_of(const SmallMatrix<S, n>& a) {
  double norm = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    double row = 0.0;
    for (std::size_t j = 0; j < n; ++j) row += std::abs(value_of(a[i * n + j]));
    norm = std::max(norm, row);
  }
  return norm;
}

/// |A| h from which on the products of matrices are fewer.
inline constexpr double longest_flow = 16.0;

/// Takes x over h of x' = A x + f(t), and adds the integral of x to `way`; `norm` is |A|, and norm h at most
/// `longest_flow`.
template <class S, int n>
void flow(const SmallMatrix<S, n>& a, double norm, double h, const Flow<S, n>& f, SmallVector<S, n>& x,
          SmallVector<S, n>& way) {
  constexpr int terms = 17;  // 1 / 18! is far below rounding
  const int parts = 1 + static_cast<int>(norm * h);
  const double length = h / parts;
  for (int part = 0; part < parts; ++part) {
    const double at = static_cast<double>(part) / parts;  // where the part begins, of h
    SmallVector<S, n> term = x, sum = x, integral = x;
    for (int k = 1; k <= terms; ++k) {
      SmallVector<S, n> next{};
      if (k == 1) {
        for (std::size_t j = 0; j < n; ++j) next[j] = f.constant[j] + at * f.linear[j] + 0.5 * at * at * f.quadratic[j];
      } else if (k == 2) {
        for (std::size_t j = 0; j < n; ++j) next[j] = (f.linear[j] + at * f.quadratic[j]) / parts;
      } else if (k == 3) {
        for (std::size_t j = 0; j < n; ++j) next[j] = 0.5 / parts / parts * f.quadratic[j];
      }
      add_product<S, n>(next, a, term);
      for (std::size_t j = 0; j < n; ++j) {
        term[j] = (length / k) * next[j];
        sum[j] += term[j];
        integral[j] += term[j] / (k + 1.0);
      }
    }
    x = sum;
    for (std::size_t j = 0; j < n; ++j) way[j] += length * integral[j];
  }
}

}  // namespace rwn
