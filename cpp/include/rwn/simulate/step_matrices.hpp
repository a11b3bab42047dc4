// The matrices that take a state over a step of given length, made from the matrix of the linear part.
//
// Where that matrix has few entries and the run many derivatives, they are made with derivatives by its entries alone,
// which the chain rule turns into those by the parameters.
#pragma once

#include "rwn/numerics/exponential.hpp"

namespace rwn {

/// What moves a state under constant terms: e^{Ah}, h phi1, h^2 phi2.
template <class T, int n>
struct LinearMatrices {
  SmallMatrix<T, n> e{}, p1{}, p2{};
};

/// And with terms that vary: half the step and the weights of Cox and Matthews. There p2 is not made.
template <class T, int n>
struct StepMatrices : LinearMatrices<T, n> {
  SmallMatrix<T, n> eh{}, p1h{}, f1{}, f2{}, f3{};
};

/// a h
template <class T, int n>
SmallMatrix<T, n> scaled(SmallMatrix<T, n> a, double h) {
  for (T& entry : a) entry *= h;
  return a;
}

/// Makes those of a step over h of x' = A x + f: constant f, or f that varies.
template <class T, int n>
void make_by_series(StepMatrices<T, n>& o, const SmallMatrix<T, n>& a, double h, bool varies) {
  if (!varies) {
    const PhiFunctions<T, n> f = phi_functions<T, n>(scaled<T, n>(a, h));
    o.e = f.p0;
    o.p1 = scaled<T, n>(f.p1, h);
    o.p2 = scaled<T, n>(f.p2, h * h);
    return;
  }
  PhiFunctions<T, n> f = phi_functions<T, n>(scaled<T, n>(a, 0.5 * h));
  o.eh = f.p0;
  o.p1h = scaled<T, n>(f.p1, 0.5 * h);
  double_argument<T, n>(f);
  o.e = f.p0;
  o.p1 = scaled<T, n>(f.p1, h);
  o.f1 = scaled<T, n>(combine<T, n>(1.0, combine<T, n>(1.0, f.p1, -3.0, f.p2), 4.0, f.p3), h);
  o.f2 = scaled<T, n>(combine<T, n>(2.0, f.p2, -4.0, f.p3), h);
  o.f3 = scaled<T, n>(combine<T, n>(-1.0, f.p2, 4.0, f.p3), h);
}

/// Derivatives by the entries are made where there are at most half as many of them.
template <class T, int n>
inline constexpr bool made_by_entries = 2 * n * n <= T::derivatives;

template <class T, int n>
void make_matrices(StepMatrices<T, n>& o, const SmallMatrix<T, n>& a, double h, bool varies) {
  if constexpr (!made_by_entries<T, n>) {
    make_by_series<T, n>(o, a, h, varies);
  } else {
    using ByEntry = typename T::template By<n * n>;
    SmallMatrix<ByEntry, n> entries;
    for (std::size_t k = 0; k < entries.size(); ++k)
      entries[k] = ByEntry::variable(value_of(a[k]), static_cast<int>(k));
    StepMatrices<ByEntry, n> by_entry;
    make_by_series<ByEntry, n>(by_entry, entries, h, varies);
    const auto chain = [&a](SmallMatrix<T, n>& to, const SmallMatrix<ByEntry, n>& from) {
      for (std::size_t k = 0; k < to.size(); ++k) to[k] = from[k].chain(a);
    };
    chain(o.e, by_entry.e);
    chain(o.p1, by_entry.p1);
    if (!varies) return chain(o.p2, by_entry.p2);
    chain(o.eh, by_entry.eh);
    chain(o.p1h, by_entry.p1h);
    chain(o.f1, by_entry.f1);
    chain(o.f2, by_entry.f2);
    chain(o.f3, by_entry.f3);
  }
}

}  // namespace rwn
