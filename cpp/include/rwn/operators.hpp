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
    double h = -1.0;
    int level = -1;
    bool stick = false;
    Matrix e{}, p1{}, p2{};                // whole step: e^{Ah}, h phi1, h^2 phi2 (p2 of linear steps only)
    Matrix eh{}, p1h{}, f1{}, f2{}, f3{};  // half step and Cox-Matthews weights (nonlinear steps only)
  };

  explicit Operators(const Equations<S, kind>& equations) : equations_(equations) {}

  /// Those of constant lengths are kept; those of instants that are searched, or carry derivatives, are made anew.
  const Step& over(const S& h, int level, bool stick) {
    const double length = value_of(h);
    if (searching_ || !is_constant(h)) {
      make(passing_, h, level, stick);
      return passing_;
    }
    for (const Step& o : kept_) {
      if (std::abs(o.h - length) <= 1e-9 * length && o.level == level && o.stick == stick) return o;
    }
    Step& slot = kept_[next_];
    next_ = (next_ + 1) % kept_.size();
    make(slot, S(length), level, stick);
    return slot;
  }

  /// While an instant is searched nothing is worth keeping.
  void search(bool on) { searching_ = on; }

 private:
  static Matrix scaled(Matrix a, const S& h) {
    for (S& entry : a) entry *= h;
    return a;
  }

  void make(Step& o, const S& h, int level, bool stick) const {
    const Matrix a = equations_.system_matrix(level, stick);
    const PhiFunctions<S, n> f = phi_functions<S, n>(scaled(a, h));
    o.h = value_of(h);
    o.level = level;
    o.stick = stick;
    o.e = f.p0;
    o.p1 = scaled(f.p1, h);
    if (!equations_.varies()) {
      o.p2 = scaled(f.p2, h * h);
      return;
    }
    const PhiFunctions<S, n> half = phi_functions<S, n>(scaled(a, 0.5 * h));
    o.eh = half.p0;
    o.p1h = scaled(half.p1, 0.5 * h);
    o.f1 = scaled(combine<S, n>(1.0, combine<S, n>(1.0, f.p1, -3.0, f.p2), 4.0, f.p3), h);
    o.f2 = scaled(combine<S, n>(2.0, f.p2, -4.0, f.p3), h);
    o.f3 = scaled(combine<S, n>(-1.0, f.p2, 4.0, f.p3), h);
  }

  const Equations<S, kind>& equations_;
  std::array<Step, 6> kept_{};
  std::size_t next_ = 0;
  Step passing_{};
  bool searching_ = false;
};

}  // namespace rwn
