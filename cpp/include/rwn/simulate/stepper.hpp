// One step of the drive equations with constant input, friction sliding or sticking and contact as it is throughout.
//
// The linear part (i, w, and twist and speed of a second mass) is solved exactly by its matrix exponential, so
// electrics and contacts much faster than the sample time cost nothing; what is nonlinear enters by a fourth-order
// exponential Runge-Kutta step (Cox, Matthews 2002). Lengths that carry derivatives, those that end at an event or a
// late command, are steps of their value, moved on along the rates of change there.
#pragma once

#include "rwn/simulate/operators.hpp"

namespace rwn {

template <class S, class Drive, int masses>
class Stepper {
 public:
  using Moving = MovingState<S, Drive, masses>;
  using State = DriveState<S, Drive, masses>;
  using Vector = typename Equations<S, Drive, masses>::Vector;
  using Matrix = typename Equations<S, Drive, masses>::Matrix;
  using Rates = SmallVector<double, State::n>;
  static constexpr int n = State::n;
  static constexpr std::size_t w = State::w;

  explicit Stepper(Equations<S, Drive, masses>& equations) : equations_(equations), operators_(equations) {}

  /// The steps that the effects and the joint ask for over h. What it learns of the start serves the first of them.
  Division divide(const State& s, double h) {
    start_known_ = equations_.rates() || (masses == 2 && equations_.varies());
    if (start_known_) start(s, 0);
    Division division = equations_.rates() ? equations_.divide(s, h, f0_, t0_) : Division{};
    if constexpr (masses == 2) {
      const Rates rate = rates(s, equations_.varies() ? f0_ : equations_.constant_part(s));
      const bool sticks = equations_.dry() && s.direction == 0.0;
      const double held = sticks ? equations_.holding(s) : 0.0;
      division.ask(equations_.second().step_count(s, rate, equations_.dry(), held, h));
    }
    return division;
  }

  State step(const State& s, const S& h) {
    if (!equations_.varies()) return linear_step(s, h);
    if (!start_known_) start(s, 0);
    start_known_ = false;
    const double length = value_of(h);
    const int level = equations_.choose_level(s, t0_, length);
    if (level != 0) start(s, level);
    const Regime regime = equations_.regime(s, level);
    ++operators_.counts.nonlinear;
    if (equations_.electrical()) ++operators_.counts.electrical;
    if (use_ == Use::intervals) return nonlinear_step(s, h, level, operators_.of_interval(length, regime));
    const double reach = operators_.system(regime).norm * length;
    if (use_ == Use::search) {
      if (reach > longest_flow_of_values) return nonlinear_step(s, h, level, operators_.values_over(length, regime));
      return nonlinear_step(s, h, level, along<Value>(length, regime));
    }
    if (reach > longest_flow) return nonlinear_step(s, h, level, operators_.of_rest(length, regime));
    return nonlinear_step(s, h, level, along<S>(length, regime));
  }

  /// Exact solution over h for constant terms; `x` and `position` may be those of `s`.
  void linear_update(const State& s, const S& h, Vector& x, S& position) {
    const Vector f = equations_.constant_part(s);
    const Regime regime = equations_.regime(s, 0);
    ++operators_.counts.linear;
    if (use_ != Use::intervals || !is_constant(h)) {
      linear_rest(s, h, regime, f, x, position);
    } else {
      go(operators_.of_interval(value_of(h), regime), s, f, x, position);
    }
  }

  /// Moves x and position by h, an interval between samples of a run in which nothing changes but the input: the step
  /// is looked up where the length is another one than before. `steady`: what accelerates the shaft besides.
  void plain_update(Vector& x, S& position, double h, const S& steady, const S& input) {
    if (!All::same(h, plain_length_)) {
      plain_ = operators_.of_interval(h, Regime(0, false, false));
      plain_length_ = h;
    }
    ++operators_.counts.linear;
    go(plain_, x, equations_.plain_part(steady, input), x, position);
  }

  /// `s` a little later, in which its rates of change last; memories of effects stay.
  State moved(const State& s, const S& later) {
    Terms<S> t;
    const Vector f = equations_.varies() ? equations_.nonlinear(s, s.memory.data(), s.position, 0, t)
                                         : equations_.constant_part(s);
    State next = s;
    shift(next.x, next.position, later, rates(s, f));
    return next;
  }

  const StepCounts& counts() const { return operators_.counts; }

  /// Effects have memories that follow the motion.
  bool finishes() const { return equations_.finishes(); }

  /// Sets what the next lengths are for; returns what they were.
  Use use(Use next) { return std::exchange(use_, next); }

 private:
  using Value = typename S::Value;
  using All = Operators<S, Drive, masses>;

  State linear_step(const State& s, const S& h) {
    State next = s;
    linear_update(s, h, next.x, next.position);
    if (equations_.finishes()) equations_.finish(s, next, h);
    return next;
  }

  /// The series along a length of a nonlinear step.
  template <class T>
  auto along(double h, const Regime& regime) {
    const auto way = operators_.template along<T>(h, regime);
    count_series(way.parts());
    return way;
  }
  void count_series(int parts) {
    (use_ == Use::search ? operators_.counts.series_of_values : operators_.counts.series) += parts;
  }

  template <class T>
  static void go(const typename All::template LinearStep<T>& o, const State& s, const Vector& constant, Vector& x,
                 S& position) {
    position = s.position;
    go(o, s.x, constant, x, position);
  }

  /// From the state `from`, which may be `x`; the position goes on from where it is.
  template <class T>
  static void go(const typename All::template LinearStep<T>& o, const Vector& from, const Vector& constant, Vector& x,
                 S& position) {
    const auto& before = All::template in<T>(from);
    const auto& f = All::template in<T>(constant);
    SmallVector<T, n> after{};
    add_product<T, n>(after, o.e, before);
    add_product<T, n>(after, o.p1, f);
    T travelled(0.0);
    for (std::size_t j = 0; j < n; ++j) travelled += o.p1[w * n + j] * before[j] + o.p2[w * n + j] * f[j];
    position += as_scalar<S>(travelled);
    x = All::template as<S>(after);
  }

  /// What is rare is kept out of the common way.
  [[gnu::noinline]] void linear_rest(const State& s, const S& h, const Regime& regime, const Vector& f, Vector& x,
                                     S& position) {
    const double length = value_of(h);
    const double reach = operators_.system(regime).norm * length;
    if (use_ == Use::search) {
      if (reach > longest_flow_of_values) {
        go(operators_.values_over(length, regime), s, f, x, position);
      } else {
        go_along<Value>(s, length, regime, f, x, position);
      }
    } else if (use_ == Use::intervals) {
      go(operators_.of_interval(length, regime), s, f, x, position);
    } else if (reach > longest_flow) {
      go(operators_.of_rest(length, regime), s, f, x, position);
    } else {
      go_along<S>(s, length, regime, f, x, position);
    }
    if (!is_constant(h)) shift(x, position, h - length, rates(operators_.system(regime).value, x, f));
  }

  template <class T>
  void go_along(const State& s, double h, const Regime& regime, const Vector& f, Vector& x, S& position) {
    SmallVector<T, n> y = All::template as<T>(s.x), way{};
    const auto& system = operators_.system(regime);
    count_series(parts_of_flow<S>(system.norm * h));
    flow<T, n>(All::template as<T>(system.a), system.norm, h, {All::template as<T>(f)}, y, way);
    x = All::template as<S>(y);
    position = s.position + as_scalar<S>(way[w]);
  }

  /// From the start that is known, by the means of `way`: a Step or a Passage of Operators.
  template <class Way>
  State nonlinear_step(const State& s, const S& length, int level, const Way& way) {
    const double h = value_of(length);
    const S& position = s.position;
    const S* memory = s.memory.data();  // as of the start of the step
    const Moving a = stage(s, way.half(s.x, f0_), 0.5 * h, s.x[w]);
    const Vector fa = equations_.nonlinear(a, memory, position, level, terms_);
    const Moving b = stage(s, way.half(s.x, fa), 0.5 * h, a.x[w]);
    Vector middle = equations_.nonlinear(b, memory, position, level, terms_);
    Vector mixed;
    for (std::size_t j = 0; j < n; ++j) mixed[j] = 2.0 * middle[j] - f0_[j];
    const Moving c = stage(s, way.half(a.x, mixed), h, b.x[w]);
    const Vector last = equations_.nonlinear(c, memory, position, level, terms_);
    for (std::size_t j = 0; j < n; ++j) middle[j] += fa[j];

    State next = s;
    next.x = way.whole(s.x, f0_, middle, last);
    next.position += (h / 6.0) * (s.x[w] + 2.0 * (a.x[w] + b.x[w]) + c.x[w]);
    if (!is_constant(length)) {
      const Vector f = equations_.nonlinear(next, memory, position, level, terms_);
      shift(next.x, next.position, length - h, rates(operators_.system(equations_.regime(s, level)).value, next.x, f));
    }
    if (equations_.finishes()) equations_.finish(s, next, length);
    return next;
  }

  /// The terms at the start of a step.
  void start(const State& s, int level) {
    f0_ = equations_.nonlinear(s, s.memory.data(), s.position, level, t0_);
  }

  RWN_INLINE static Moving stage(const Moving& s, const Vector& x, double h, const S& speed) {
    Moving r = s;
    r.x = x;
    r.position += h * speed;
    return r;
  }

  /// dx/dt at `s`, where f is what its linear part leaves.
  Rates rates(const State& s, const Vector& f) {
    return rates(operators_.system(equations_.regime(s, 0)).value, s.x, f);
  }

  static Rates rates(const SmallMatrix<double, n>& a, const Vector& x, const Vector& f) {
    Rates rate{};
    for (std::size_t i = 0; i < n; ++i) {
      rate[i] = value_of(f[i]);
      for (std::size_t j = 0; j < n; ++j) rate[i] += a[i * n + j] * value_of(x[j]);
    }
    return rate;
  }

  /// Moves a state on by `more`, which has derivatives and no length.
  static void shift(Vector& x, S& position, const S& more, const Rates& rates) {
    for (std::size_t i = 0; i < n; ++i) x[i] += rates[i] * more;
    position += value_of(x[w]) * more;
  }

  Equations<S, Drive, masses>& equations_;
  Operators<S, Drive, masses> operators_;
  Vector f0_{};  // at the start of a step, with its terms
  Terms<S> t0_{};
  Terms<S> terms_{};  // of a stage
  typename All::template LinearStep<S>
      plain_{};  // of intervals as long as this; a copy: the operators' own are replaced
  double plain_length_ = -1.0;
  bool start_known_ = false;
  Use use_ = Use::intervals;
};

}  // namespace rwn
