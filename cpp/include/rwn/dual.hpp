// Forward-mode dual numbers: a value and its derivatives by N parameters, so that one set of equations gives both.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

namespace rwn {

/// No derivatives at all; takes no room (an empty std::array does).
struct NoSlopes {
  double& operator[](std::size_t) { __builtin_unreachable(); }
  double operator[](std::size_t) const { __builtin_unreachable(); }
  const double* begin() const { return nullptr; }
  const double* end() const { return nullptr; }
};

/// Value `v` and partial derivatives `d[0..N)`. `Isa` is a tag that keeps instantiations of different instruction sets
/// apart, so that the linker never merges them; N = 0 is a plain number at no cost.
template <int N, class Isa>
struct Dual {
  double v = 0.0;
  [[no_unique_address]] std::conditional_t<N == 0, NoSlopes, std::array<double, N>> d{};

  Dual() = default;
  Dual(double value) : v(value) {}  // NOLINT: constants mix with duals in the equations

  static Dual variable(double value, int index) {
    Dual x(value);
    if (index >= 0 && index < N) {
      x.d[static_cast<std::size_t>(index)] = 1.0;
    }
    return x;
  }

  /// f(x) given f and f' at the value.
  Dual chain(double f, double slope) const {
    Dual y(f);
    for (std::size_t k = 0; k < N; ++k) y.d[k] = slope * d[k];
    return y;
  }

  /// Slopes that are infinite or undefined (of a root or logarithm at zero) become 0.
  void clear_wild_slopes() {
    for (std::size_t k = 0; k < N; ++k) d[k] = std::isfinite(d[k]) ? d[k] : 0.0;
  }

  Dual& operator+=(const Dual& o) {
    v += o.v;
    for (std::size_t k = 0; k < N; ++k) d[k] += o.d[k];
    return *this;
  }
  Dual& operator-=(const Dual& o) {
    v -= o.v;
    for (std::size_t k = 0; k < N; ++k) d[k] -= o.d[k];
    return *this;
  }
  Dual& operator*=(const Dual& o) { return *this = *this * o; }
  Dual& operator/=(const Dual& o) { return *this = *this / o; }
  Dual& operator*=(double o) {
    v *= o;
    for (std::size_t k = 0; k < N; ++k) d[k] *= o;
    return *this;
  }

  friend Dual operator+(Dual a, const Dual& b) { return a += b; }
  friend Dual operator-(Dual a, const Dual& b) { return a -= b; }
  friend Dual operator+(Dual a, double b) {
    a.v += b;
    return a;
  }
  friend Dual operator+(double a, Dual b) { return b + a; }
  friend Dual operator-(Dual a, double b) { return a + (-b); }
  friend Dual operator-(double a, const Dual& b) {
    Dual y(a - b.v);
    for (std::size_t k = 0; k < N; ++k) y.d[k] = -b.d[k];
    return y;
  }
  friend Dual operator-(const Dual& a) { return 0.0 - a; }
  friend Dual operator*(const Dual& a, const Dual& b) {
    Dual y(a.v * b.v);
    for (std::size_t k = 0; k < N; ++k) y.d[k] = a.d[k] * b.v + a.v * b.d[k];
    return y;
  }
  friend Dual operator*(Dual a, double b) { return a *= b; }
  friend Dual operator*(double a, Dual b) { return b *= a; }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const double inverse = 1.0 / b.v;
    Dual y(a.v * inverse);
    for (std::size_t k = 0; k < N; ++k) y.d[k] = (a.d[k] - y.v * b.d[k]) * inverse;
    return y;
  }
  friend Dual operator/(const Dual& a, double b) { return a * (1.0 / b); }
  friend Dual operator/(double a, const Dual& b) {
    const double inverse = 1.0 / b.v;
    return b.chain(a * inverse, -a * inverse * inverse);
  }

  friend Dual exp(const Dual& x) {
    const double e = std::exp(x.v);
    return x.chain(e, e);
  }
  friend Dual log(const Dual& x) { return x.chain(std::log(x.v), 1.0 / x.v); }
  friend Dual sin(const Dual& x) { return x.chain(std::sin(x.v), std::cos(x.v)); }
  friend Dual cos(const Dual& x) { return x.chain(std::cos(x.v), -std::sin(x.v)); }
  friend Dual tan(const Dual& x) {
    const double t = std::tan(x.v);
    return x.chain(t, 1.0 + t * t);
  }
  friend Dual atan(const Dual& x) { return x.chain(std::atan(x.v), 1.0 / (1.0 + x.v * x.v)); }
  friend Dual tanh(const Dual& x) {
    const double t = std::tanh(x.v);
    return x.chain(t, 1.0 - t * t);
  }
  friend Dual sqrt(const Dual& x) {
    const double r = std::sqrt(x.v);
    return x.chain(r, r > 0.0 ? 0.5 / r : 0.0);
  }
  friend Dual pow(const Dual& a, const Dual& b) {
    const double f = std::pow(a.v, b.v);
    const double by_a = a.v != 0.0 ? b.v * f / a.v : b.v == 1.0 ? 1.0 : 0.0;
    const double by_b = a.v > 0.0 ? f * std::log(a.v) : 0.0;
    Dual y(f);
    for (std::size_t k = 0; k < N; ++k) y.d[k] = by_a * a.d[k] + by_b * b.d[k];
    return y;
  }
  friend Dual abs(const Dual& x) { return x.v < 0.0 ? -x : x; }
};

template <int N, class Isa>
double value_of(const Dual<N, Isa>& x) {
  return x.v;
}
inline double value_of(double x) { return x; }

/// True where no derivative is carried.
template <int N, class Isa>
bool is_constant(const Dual<N, Isa>& x) {
  for (double slope : x.d) {
    if (slope != 0.0) return false;
  }
  return true;
}

}  // namespace rwn
