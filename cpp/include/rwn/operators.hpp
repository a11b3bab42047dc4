// The matrices by which a step of given length moves the state, made once for each length that comes back.
#pragma once

#include "rwn/equations.hpp"

namespace rwn {

template <class S, Kind kind>
class Operators {
 public:
  using Matrix = typename Equations<S, kind>::Matrix;
  static constexpr int n = Equations<S, kind>::n;

  struct Step {
    S h{-1.0};
    int level = -1;
    bool stick = false;
    Matrix e{}, p1{}, p2{};                // whole step: e^{Ah}, h phi1, h^2 phi2 (p2 of linear steps only)
    Matrix eh{}, p1h{}, f1{}, f2{}, f3{};  // half step and Cox-Matthews weights (nonlinear steps only)
  };

  explicit Operators(const Equations<S, kind>& equations) : equations_(equations) {}

  /// Those of constant lengths are kept, and the last few that carry derivatives: a late command divides every sample
  /// alike. Those of instants that are searched are made anew, without derivatives.
  const Step& over(const S& h, int level, bool stick) {
    if (searching_) {
      make<Value>(passing_, h, level, stick);
      return passing_;
    }
    return is_constant(h) ? constant_.over(*this, h, level, stick) : sloped_.over(*this, h, level, stick);
  }

  /// While an instant is searched nothing is worth keeping, and values alone are wanted.
  void search(bool on) { searching_ = on; }

 private:
  using Value = typename S::Value;

  /// The last few that were made.
  template <std::size_t size>
  struct Kept {
    std::array<Step, size> steps{};
    std::size_t next = 0;

    const Step& over(const Operators& maker, const S& h, int level, bool stick) {
      const double length = value_of(h);
      for (const Step& o : steps) {
        const bool as_long = std::abs(value_of(o.h) - length) <= 1e-9 * length;
        if (as_long && o.level == level && o.stick == stick && same_slopes(o.h, h)) return o;
      }
      Step& slot = steps[next];
      next = (next + 1) % size;
      maker.template make<S>(slot, h, level, stick);
      return slot;
    }
  };

  template <class T>
  static SmallMatrix<T, n> scaled(SmallMatrix<T, n> a, const T& h) {
    for (T& entry : a) entry *= h;
    return a;
  }

  template <class T, class From>
  static SmallMatrix<T, n> as(const From& from) {
    SmallMatrix<T, n> a;
    for (std::size_t k = 0; k < a.size(); ++k) a[k] = as_scalar<T>(from[k]);
    return a;
  }

  /// Computed in scalar T: S, or values alone.
  template <class T>
  void make(Step& o, const S& length, int level, bool stick) const {
    const SmallMatrix<T, n> a = as<T>(equations_.system_matrix(level, stick));
    const T h = as_scalar<T>(length);
    const PhiFunctions<T, n> f = phi_functions<T, n>(scaled<T>(a, h));
    o.h = length;
    o.level = level;
    o.stick = stick;
    o.e = as<S>(f.p0);
    o.p1 = as<S>(scaled<T>(f.p1, h));
    if (!equations_.varies()) {
      o.p2 = as<S>(scaled<T>(f.p2, h * h));
      return;
    }
    const PhiFunctions<T, n> half = phi_functions<T, n>(scaled<T>(a, 0.5 * h));
    o.eh = as<S>(half.p0);
    o.p1h = as<S>(scaled<T>(half.p1, 0.5 * h));
    o.f1 = as<S>(scaled<T>(combine<T, n>(1.0, combine<T, n>(1.0, f.p1, -3.0, f.p2), 4.0, f.p3), h));
    o.f2 = as<S>(scaled<T>(combine<T, n>(2.0, f.p2, -4.0, f.p3), h));
    o.f3 = as<S>(scaled<T>(combine<T, n>(-1.0, f.p2, 4.0, f.p3), h));
  }

  const Equations<S, kind>& equations_;
  Kept<6> constant_{};
  Kept<4> sloped_{};
  Step passing_{};
  bool searching_ = false;
};

}  // namespace rwn
