// One linear system over one length: its Taylor series, which costs a few products of matrix and vector where the
// functions of rwn/numerics/exponential.hpp cost products of matrices.
#pragma once

#include "rwn/numerics/exponential.hpp"

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

/// The same once every state is measured so that its row and its column weigh alike (Osborne 1960): it bounds how fast
/// anything changes, whatever the units of the states.
template <int n>
double balanced_norm(SmallMatrix<double, n> a) {
  for (int sweep = 0; sweep < 4; ++sweep) {
    for (std::size_t i = 0; i < n; ++i) {
      double row = 0.0, column = 0.0;
      for (std::size_t j = 0; j < n; ++j) {
        if (j == i) continue;
        row += std::abs(a[i * n + j]);
        column += std::abs(a[j * n + i]);
      }
      if (row == 0.0 || column == 0.0) continue;
      const double scale = std::sqrt(column / row);
      for (std::size_t j = 0; j < n; ++j) {
        a[i * n + j] *= scale;
        a[j * n + i] /= scale;
      }
    }
  }
  double norm = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    double row = 0.0;
    for (std::size_t j = 0; j < n; ++j) row += std::abs(a[i * n + j]);
    norm = std::max(norm, row);
  }
  return norm;
}

/// Parts in which a length is gone along, of which each has |A| h < 1.
template <class S>
int parts_of_flow(double reach) {
  return 1 + static_cast<int>(reach);
}

/// |A| h from which on matrices are made sooner: with derivatives, and of values alone.
inline constexpr double longest_flow = 6.0, longest_flow_of_values = 1.0;

/// Terms of the series over |A| h = `reach` <= 1, behind which it and its quadrature are below rounding.
template <class S>
int terms_of_flow(double reach) {
  int k = 3;  // the first with all of f
  for (double left = reach / 4.0; left > 1e-15; left *= reach / (k + 1.0)) ++k;
  return k;
}

/// Takes x over h of x' = A x + f(t), and adds the integral of x to `way`; `norm` is |A|.
template <class S, int n>
void flow(const SmallMatrix<S, n>& a, double norm, double h, const Flow<S, n>& f, SmallVector<S, n>& x,
          SmallVector<S, n>& way) {
  const int parts = parts_of_flow<S>(norm * h);
  const double length = h / parts;
  const int terms = terms_of_flow<S>(norm * length);
  SmallMatrix<S, n> columns;  // so that a product goes on in all rows at once
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) columns[j * n + i] = a[i * n + j];
  }
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
      for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t i = 0; i < n; ++i) add_product(next[i], columns[j * n + i], term[j]);
      }
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
