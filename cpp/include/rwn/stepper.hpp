// One step of the drive equations with constant input, friction sliding or sticking throughout.
//
// The linear part (i, w) is solved exactly by its matrix exponential, so electrics much faster than the sample time
// cost nothing; what is nonlinear enters by a fourth-order exponential Runge-Kutta step (Cox, Matthews 2002).
#pragma once

#include "rwn/operators.hpp"

namespace rwn {

template <class S, Kind kind>
class Stepper {
 public:
  using Moving = MovingState<S, kind>;
  using State = DriveState<S, kind>;
  using Vector = typename Equations<S, kind>::Vector;
  using Matrix = typename Equations<S, kind>::Matrix;
  static constexpr int n = State::n;
  static constexpr std::size_t w = n - 1;

  explicit Stepper(Equations<S, kind>& equations) : equations_(equations), operators_(equations) {}

  /// Steps that the fastest effect asks for over h. What it learns of the start serves the first of them.
  int step_count(const State& s, double h) {
    start_known_ = equations_.rates();
    if (!start_known_) return 1;
    start(s, 0);
    return equations_.step_count(s, h, f0_, t0_);
  }

  State step(const State& s, const S& h) { return equations_.varies() ? nonlinear_step(s, h) : linear_step(s, h); }

  /// Exact solution over h for constant terms; `x` and `position` may be those of `s`.
  void linear_update(const State& s, const S& h, Vector& x, S& position) {
    const auto& o = operators_.over(h, 0, equations_.dry() && s.direction == 0.0);
    const Vector f = equations_.constant_part(s);
    Vector after{};
    add_product<S, n>(after, o.e, s.x);
    add_product<S, n>(after, o.p1, f);
    S travelled = s.position;
    for (std::size_t j = 0; j < n; ++j) travelled += o.p1[w * n + j] * s.x[j] + o.p2[w * n + j] * f[j];
    x = after;
    position = travelled;
  }

  /// See `Operators::search`.
  void search(bool on) { operators_.search(on); }

 private:
  State linear_step(const State& s, const S& h) {
    State next = s;
    linear_update(s, h, next.x, next.position);
    if (equations_.finishes()) equations_.finish(s, next, h);
    return next;
  }

  State nonlinear_step(const State& s, const S& h) {
    const bool stick = equations_.dry() && s.direction == 0.0;
    if (!start_known_) start(s, 0);
    start_known_ = false;
    const int level = equations_.choose_level(s, t0_);
    if (level != 0) start(s, level);
    const auto& o = operators_.over(h, level, stick);
    const S& position = s.position;
    const S* memory = s.memory.data();  // as of the start of the step
    Terms<S> ta, tb, tc;
    const Moving a = stage(s, o.eh, s.x, o.p1h, f0_, 0.5 * h, s.x[w], t0_);
    const Vector fa = equations_.nonlinear(a, memory, position, level, ta);
    const Moving b = stage(s, o.eh, s.x, o.p1h, fa, 0.5 * h, a.x[w], ta);
    const Vector fb = equations_.nonlinear(b, memory, position, level, tb);
    Vector mixed = fb;
    for (std::size_t j = 0; j < n; ++j) mixed[j] = 2.0 * fb[j] - f0_[j];
    const Moving c = stage(s, o.eh, a.x, o.p1h, mixed, h, b.x[w], tb);
    const Vector fc = equations_.nonlinear(c, memory, position, level, tc);

    State next = s;
    next.x = Vector{};
    add_product<S, n>(next.x, o.e, s.x);
    add_product<S, n>(next.x, o.f1, f0_);
    for (std::size_t j = 0; j < n; ++j) mixed[j] = fa[j] + fb[j];
    add_product<S, n>(next.x, o.f2, mixed);
    add_product<S, n>(next.x, o.f3, fc);
    const S sixth = h / 6.0;
    next.position += sixth * (s.x[w] + 2.0 * (a.x[w] + b.x[w]) + c.x[w]);
    if (equations_.hiddens()) {
      for (std::size_t k = 0; k < next.hidden.size(); ++k) {
        next.hidden[k] +=
            sixth * (t0_.hidden_rate[k] + 2.0 * (ta.hidden_rate[k] + tb.hidden_rate[k]) + tc.hidden_rate[k]);
      }
    }
    if (equations_.finishes()) equations_.finish(s, next, h);
    return next;
  }

  /// The terms at the start of a step.
  void start(const State& s, int level) {
    t0_ = {};
    f0_ = equations_.nonlinear(s, s.memory.data(), s.position, level, t0_);
  }

  Moving stage(const Moving& s, const Matrix& e, const Vector& from, const Matrix& p1, const Vector& f, const S& h,
               const S& speed, const Terms<S>& t) const {
    Moving r;
    r.direction = s.direction;
    add_product<S, n>(r.x, e, from);
    add_product<S, n>(r.x, p1, f);
    r.position = s.position + h * speed;
    if (equations_.hiddens()) {
      for (std::size_t k = 0; k < r.hidden.size(); ++k) r.hidden[k] = s.hidden[k] + h * t.hidden_rate[k];
    }
    return r;
  }

  Equations<S, kind>& equations_;
  Operators<S, kind> operators_;
  Vector f0_{};  // at the start of a step, with its terms
  Terms<S> t0_{};
  bool start_known_ = false;
};

}  // namespace rwn
