// Forward-mode dual numbers: a value and its derivatives by N parameters, so that one set of equations gives both.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "rwn/numerics/vectors.hpp"

namespace rwn {

/// Vectors of derivatives one after the other. Members, not an array: the compiler keeps members in registers and
/// copies them whole, where an array of three is copied in pieces that wait for what has just been stored.
template <int count, class Isa>
struct Vectors {
  using Vector [[gnu::vector_size(RWN_VECTOR_WIDTH * sizeof(double))]] = double;
  Vector first{};
  [[no_unique_address]] Vectors<count - 1, Isa> rest{};

  double get(int k) const { return k < RWN_VECTOR_WIDTH ? first[k] : rest.get(k - RWN_VECTOR_WIDTH); }
  void set(int k, double value) {
    if (k < RWN_VECTOR_WIDTH) {
      first[k] = value;
    } else {
      rest.set(k - RWN_VECTOR_WIDTH, value);
    }
  }
  RWN_INLINE void add(const Vectors& o) {
    first += o.first;
    rest.add(o.rest);
  }
  RWN_INLINE void subtract(const Vectors& o) {
    first -= o.first;
    rest.subtract(o.rest);
  }
  RWN_INLINE void scale(double factor) {
    first *= factor;
    rest.scale(factor);
  }
};

template <class Isa>
struct Vectors<0, Isa> {
  double get(int) const { __builtin_unreachable(); }
  void set(int, double) {}
  RWN_INLINE void add(Vectors) {}
  RWN_INLINE void subtract(Vectors) {}
  RWN_INLINE void scale(double) {}
};

/// N derivatives (rounded up to whole vectors) in the processor's own vectors.
template <int N, class Isa>
struct Slopes {
  Vectors<(N + RWN_VECTOR_WIDTH - 1) / RWN_VECTOR_WIDTH, Isa> all{};

  double operator[](int k) const { return all.get(k); }
  void set(int k, double value) { all.set(k, value); }
  RWN_INLINE Slopes& operator+=(const Slopes& o) {
    all.add(o.all);
    return *this;
  }
  RWN_INLINE Slopes& operator-=(const Slopes& o) {
    all.subtract(o.all);
    return *this;
  }
  RWN_INLINE friend Slopes operator+(Slopes a, const Slopes& b) { return a += b; }
  RWN_INLINE friend Slopes operator-(Slopes a, const Slopes& b) { return a -= b; }
  RWN_INLINE friend Slopes operator-(Slopes a) { return -1.0 * a; }
  RWN_INLINE friend Slopes operator*(double factor, Slopes a) {
    a.all.scale(factor);
    return a;
  }
};

/// One derivative: a number, not a vector of which the rest would be idle.
template <class Isa>
struct Slopes<1, Isa> {
  double part = 0.0;

  double operator[](int) const { return part; }
  void set(int, double value) { part = value; }
  RWN_INLINE Slopes& operator+=(Slopes o) {
    part += o.part;
    return *this;
  }
  RWN_INLINE Slopes& operator-=(Slopes o) {
    part -= o.part;
    return *this;
  }
  RWN_INLINE friend Slopes operator+(Slopes a, Slopes b) { return {a.part + b.part}; }
  RWN_INLINE friend Slopes operator-(Slopes a, Slopes b) { return {a.part - b.part}; }
  RWN_INLINE friend Slopes operator-(Slopes a) { return {-a.part}; }
  RWN_INLINE friend Slopes operator*(double factor, Slopes a) { return {factor * a.part}; }
};

/// No derivatives at all; takes no room.
template <class Isa>
struct Slopes<0, Isa> {
  double operator[](int) const { __builtin_unreachable(); }
  void set(int, double) {}
  RWN_INLINE Slopes& operator+=(Slopes) { return *this; }
  RWN_INLINE Slopes& operator-=(Slopes) { return *this; }
  RWN_INLINE friend Slopes operator+(Slopes, Slopes) { return {}; }
  RWN_INLINE friend Slopes operator-(Slopes, Slopes) { return {}; }
  RWN_INLINE friend Slopes operator-(Slopes) { return {}; }
  RWN_INLINE friend Slopes operator*(double, Slopes) { return {}; }
};

/// Value `v` and partial derivatives `d[0..N)`. `Isa` is a tag that keeps instantiations of different
/// instruction sets apart, so that the linker never merges them; N = 0 is a plain number at no cost.
template <int N, class Isa>
struct Dual {
  using Value = Dual<0, Isa>;
  template <int M>
  using By = Dual<M, Isa>;  // by as many other parameters
  static constexpr int derivatives = N;

  [[no_unique_address]] Slopes<N, Isa> d{};
  double v = 0.0;

  Dual() = default;
  Dual(const Dual&) = default;  // without derivatives, a number
  Dual& operator=(const Dual&) = default;
  // Member by member: copied whole, what lies behind `v` is loaded with it, and waits for what has just been stored.
  RWN_INLINE Dual(const Dual& o) requires(N > 0) : d(o.d), v(o.v) {}
  RWN_INLINE Dual& operator=(const Dual& o) requires(N > 0) {
    d = o.d;
    v = o.v;
    return *this;
  }
  Dual(double value) : v(value) {}  // NOLINT: constants mix with duals in the equations

  static Dual variable(double value, int index) {
    Dual x(value);
    if (index >= 0 && index < N) x.d.set(index, 1.0);
    return x;
  }

  /// f(x) given f and f' at the value.
  RWN_INLINE Dual chain(double f, double slope) const {
    Dual y(f);
    y.d = slope * d;
    return y;
  }

  /// The same number by the parameters of `inner`, the k-th of which this one's k-th derivative is by.
  template <int M>
  RWN_INLINE Dual<M, Isa> chain(const std::array<Dual<M, Isa>, static_cast<std::size_t>(N)>& inner) const {
    Dual<M, Isa> y(v);
    for (std::size_t k = 0; k < inner.size(); ++k) y.d += d[static_cast<int>(k)] * inner[k].d;
    return y;
  }

  /// Slopes that are infinite or undefined (of a root or logarithm at zero) become 0.
  void clear_wild_slopes() {
    for (int k = 0; k < N; ++k) d.set(k, std::isfinite(d[k]) ? d[k] : 0.0);
  }

  RWN_INLINE Dual& operator+=(const Dual& o) {
    v += o.v;
    d += o.d;
    return *this;
  }
  RWN_INLINE Dual& operator-=(const Dual& o) {
    v -= o.v;
    d -= o.d;
    return *this;
  }
  RWN_INLINE Dual& operator*=(const Dual& o) { return *this = *this * o; }
  RWN_INLINE Dual& operator/=(const Dual& o) { return *this = *this / o; }
  RWN_INLINE Dual& operator*=(double o) {
    v *= o;
    d = o * d;
    return *this;
  }

  RWN_INLINE friend Dual operator+(Dual a, const Dual& b) { return a += b; }
  RWN_INLINE friend Dual operator-(Dual a, const Dual& b) { return a -= b; }
  RWN_INLINE friend Dual operator+(Dual a, double b) {
    a.v += b;
    return a;
  }
  RWN_INLINE friend Dual operator+(double a, Dual b) { return b + a; }
  RWN_INLINE friend Dual operator-(Dual a, double b) { return a + (-b); }
  RWN_INLINE friend Dual operator-(double a, const Dual& b) {
    Dual y(a - b.v);
    y.d = -b.d;
    return y;
  }
  RWN_INLINE friend Dual operator-(const Dual& a) {
    Dual y(-a.v);  // minus zero is kept
    y.d = -a.d;
    return y;
  }
  RWN_INLINE friend Dual operator*(const Dual& a, const Dual& b) {
    Dual y(a.v * b.v);
    y.d = b.v * a.d + a.v * b.d;
    return y;
  }
  /// sum += a b
  RWN_INLINE friend void add_product(Dual& sum, const Dual& a, const Dual& b) {
    sum.v += a.v * b.v;
    sum.d += b.v * a.d;
    sum.d += a.v * b.d;
  }
  RWN_INLINE friend Dual operator*(Dual a, double b) { return a *= b; }
  RWN_INLINE friend Dual operator*(double a, Dual b) { return b *= a; }
  RWN_INLINE friend Dual operator/(const Dual& a, const Dual& b) {
    const double inverse = 1.0 / b.v;
    Dual y(a.v * inverse);
    y.d = inverse * (a.d - y.v * b.d);
    return y;
  }
  RWN_INLINE friend Dual operator/(const Dual& a, double b) { return a * (1.0 / b); }
  RWN_INLINE friend Dual operator/(double a, const Dual& b) {
    const double inverse = 1.0 / b.v;
    return b.chain(a * inverse, -a * inverse * inverse);
  }

  friend Dual exp(const Dual& x) {
    if (x.v < -700.0) return Dual(0.0);  // below 1e-304: underflow takes libm longer than all else
    const double e = std::exp(x.v);
    return x.chain(e, e);
  }
  friend Dual expm1(const Dual& x) {
    const double e = std::expm1(x.v);
    return x.chain(e, 1.0 + e);
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
    y.d = by_a * a.d + by_b * b.d;
    return y;
  }
  friend Dual abs(const Dual& x) { return x.v < 0.0 ? -x : x; }
};

template <int N, class Isa>
double value_of(const Dual<N, Isa>& x) {
  return x.v;
}
inline double value_of(double x) { return x; }

/// The same number as a T: itself, or its value alone.
template <class T, class From>
T as_scalar(const From& x) {
  if constexpr (std::is_same_v<T, From>) {
    return x;
  } else {
    return T(value_of(x));
  }
}

/// True where both carry the same derivatives.
template <int N, class Isa>
bool same_slopes(const Dual<N, Isa>& a, const Dual<N, Isa>& b) {
  for (int k = 0; k < N; ++k) {
    if (a.d[k] != b.d[k]) return false;
  }
  return true;
}

/// True where no derivative is carried.
template <int N, class Isa>
bool is_constant(const Dual<N, Isa>& x) {
  for (int k = 0; k < N; ++k) {
    if (x.d[k] != 0.0) return false;
  }
  return true;
}
constexpr bool is_constant(double) { return true; }

/// False of a zero that nothing is differentiated by: what it multiplies is not there.
template <class S>
constexpr bool is_used(const S& x) {
  return value_of(x) != 0.0 || !is_constant(x);
}

}  // namespace rwn
