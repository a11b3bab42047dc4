// Integrates the drive equations over one interval of constant input.
//
// The linear part (i, w) is solved exactly by its matrix exponential, so electrics much faster than the sample time
// cost nothing; what is nonlinear enters by a fourth-order exponential Runge-Kutta step (Cox, Matthews 2002). Dry
// friction is set-valued: the instants at which sliding stops and sticking breaks away are located, and carried in the
// scalar S so that the derivatives include their shift.
#pragma once

#include <algorithm>
#include <cmath>

#include "rwn/active_effects.hpp"
#include "rwn/exponential.hpp"

namespace rwn {

template <class S, Kind kind>
class Integrator {
 public:
  static constexpr int n = kind == Kind::dc ? 2 : 1;
  static constexpr std::size_t w = n - 1;  // index of speed in x
  using Vector = SmallVector<S, n>;
  using Matrix = SmallMatrix<S, n>;

  struct State {
    Vector x{};  // current (dc only), speed
    S position{};
    std::array<S, 2> hidden{};
    std::array<S, max_memories> memory{};
    double direction = 0.0;  // of sliding; 0 sticks
  };

  Integrator(const Motor<S>& motor, const ActiveEffect<S>* effects, int count, double angle_per_position)
      : motor_(motor), effects_(effects), count_(count), angle_per_position_(angle_per_position) {
    bool replaced = false;
    for (int k = 0; k < count_; ++k) {
      const auto& call = effects_[k].call;
      varies_ = varies_ || call.varies;
      dry_ = dry_ || call.dry;
      electrical_ = electrical_ || call.electrical;
      rates_ = rates_ || call.rate != nullptr;
      timed_ = timed_ || call.breaks != nullptr;
      replaced = replaced || call.replaces;
      hiddens_ = hiddens_ || call.hiddens > 0;
      finishes_ = finishes_ || call.finish != nullptr;
    }
    base_friction_ = replaced ? S(0.0) : motor_[coulomb_friction];
    dry_ = dry_ || (!replaced && is_used(motor_[coulomb_friction]));
    pendulum_ = is_used(motor_[pendulum_torque]);
    varies_ = varies_ || pendulum_;
    inverse_inertia_ = 1.0 / motor_[inertia];
    if constexpr (kind == Kind::dc) inverse_inductance_ = 1.0 / motor_[inductance];
  }

  bool linear() const { return !varies_ && !dry_ && !finishes_; }

  /// Recorded minus simulated position, where angle-dependent effects follow the recorded one.
  void follow(double offset) { offset_ = offset; }

  /// Fixes sliding or sticking of a state that has just been set.
  void settle(State& s) const {
    if (dry_) s.direction = value_of(s.x[w]) > 0.0 ? 1.0 : value_of(s.x[w]) < 0.0 ? -1.0 : 0.0;
  }

  /// Advances `s` over `h` from time `time` with constant input.
  void advance(State& s, S h, const S& input, double time) {
    input_ = input;
    time_ = time + 0.5 * value_of(h);
    if (timed_) constants_known_ = {};
    if (dry_) {
      advance_with_friction(s, h);
      return;
    }
    if (!varies_ && !finishes_) {
      linear_update(s, h, s.x, s.position);
      return;
    }
    const int steps = step_count(s, value_of(h));
    const S part = steps == 1 ? h : h / static_cast<double>(steps);
    for (int k = 0; k < steps; ++k) s = step(s, part);
  }

 private:
  struct Operators {
    double h = -1.0;
    int level = -1;
    bool stick = false;
    bool full = false;
    Matrix e, p1, p2;            // whole step: e^{Ah}, h phi1, h^2 phi2
    Matrix eh, p1h, f1, f2, f3;  // half step and Cox-Matthews weights
  };

  static bool is_used(const S& x) {
    bool used = value_of(x) != 0.0;
    if constexpr (requires { x.d; }) {
      for (double slope : x.d) used = used || slope != 0.0;
    }
    return used;
  }
  static bool is_constant(const S& x) {
    if constexpr (requires { x.d; }) {
      for (double slope : x.d) {
        if (slope != 0.0) return false;
      }
    }
    return true;
  }

  // ---- the equations ----------------------------------------------------------------------------------------------

  Motion<S> motion_of(const State& s, const S& start) const {
    Motion<S> x;
    x.time = time_;
    x.direction = s.direction;
    x.input = input_;
    if constexpr (kind == Kind::dc) x.current = s.x[0];
    x.speed = s.x[w];
    x.position = s.position;
    x.angle = angle_per_position_ * (s.position + offset_);
    x.angle_per_position = angle_per_position_;
    x.travel = s.position - start;
    x.hidden = s.hidden.data();
    x.drive_torque = kind == Kind::dc ? motor_[torque_constant] * x.current : input_;
    return x;
  }

  Terms<S> terms_of(const State& s, const S& start) const {
    Terms<S> t;
    t.friction = base_friction_;
    Motion<S> x = motion_of(s, start);
    for (int k = 0; k < count_; ++k) {
      if (effects_[k].call.apply == nullptr) continue;
      x.memory = s.memory.data() + effects_[k].memory;
      effects_[k].call.apply(effects_[k].p, motor_, x, t);
    }
    if (pendulum_) {
      using std::sin;
      t.torque -= motor_[pendulum_torque] * sin(s.position);
    }
    return t;
  }

  S drive_torque(const State& s, const Terms<S>& t) const {
    if constexpr (kind == Kind::dc) return motor_[torque_constant] * t.flux * s.x[0];
    return input_ * t.flux;
  }

  /// Torque that acts on the standing shaft, dry friction aside.
  S standing_torque(const State& s, const Terms<S>& t) const { return drive_torque(s, t) + t.torque; }

  /// dx/dt - A x, with A of level `level` (see `choose_level`).
  Vector nonlinear(const State& s, const S& start, int level, Terms<S>& t) const {
    t = terms_of(s, start);
    Vector f;
    if constexpr (kind == Kind::dc) {
      const S back_emf = motor_[back_emf_constant] * s.x[1];
      S rate = (input_ - motor_[resistance] * t.resistance * s.x[0] - back_emf * t.flux - t.drop) * inverse_inductance_;
      if (value_of(t.inductance) != 1.0) rate /= t.inductance;
      f[0] = rate + (std::ldexp(1.0, level) * motor_[resistance] * s.x[0] + back_emf) * inverse_inductance_;
    }
    if (s.direction == 0.0 && dry_) {
      f[w] = S(0.0);
      return f;
    }
    S torque = drive_torque(s, t) + t.torque - motor_[viscous_friction] * s.x[w];
    if (dry_) torque -= s.direction * t.friction;
    if (value_of(t.inertia_slope) != 0.0) torque -= 0.5 * t.inertia_slope * s.x[w] * s.x[w];
    const S linear_rate = linear_acceleration(s);
    f[w] = value_of(t.inertia) == 0.0 ? torque * inverse_inertia_ : torque / (motor_[inertia] + t.inertia);
    f[w] -= linear_rate;
    return f;
  }

  S linear_acceleration(const State& s) const {
    S torque = -(motor_[viscous_friction] * s.x[w]);
    if constexpr (kind == Kind::dc) torque += motor_[torque_constant] * s.x[0];
    return torque * inverse_inertia_;
  }

  /// The same where no effect varies within a step: the terms depend on direction alone.
  Vector constant_part(const State& s) {
    const std::size_t place = s.direction > 0.0 ? 2 : s.direction < 0.0 ? 0 : 1;
    const bool stick = dry_ && place == 1;
    if (!constants_known_[place]) {
      const Terms<S> t = terms_of(s, s.position);
      constants_[place] = stick ? S(0.0) : (t.torque - s.direction * t.friction) * inverse_inertia_;
      constants_known_[place] = true;
    }
    Vector f;
    f[w] = constants_[place];
    if constexpr (kind == Kind::dc) {
      f[0] = input_ * inverse_inductance_;
    } else if (!stick) {
      f[w] += input_ * inverse_inertia_;
    }
    return f;
  }

  // ---- one step -----------------------------------------------------------------------------------------------------

  Matrix system_matrix(int level, bool stick) const {
    Matrix a{};
    if constexpr (kind == Kind::dc) {
      a[0] = -(std::ldexp(1.0, level) * motor_[resistance] * inverse_inductance_);
      a[1] = -(motor_[back_emf_constant] * inverse_inductance_);
      if (!stick) a[2] = motor_[torque_constant] * inverse_inertia_;
    }
    if (!stick) a[n * n - 1] = -(motor_[viscous_friction] * inverse_inertia_);
    return a;
  }

  static Matrix scaled(Matrix a, const S& h) {
    for (S& entry : a) entry *= h;
    return a;
  }

  void make_operators(Operators& o, const S& h, int level, bool stick) const {
    const Matrix a = system_matrix(level, stick);
    const PhiFunctions<S, n> f = phi_functions<S, n>(scaled(a, h));
    o.h = value_of(h);
    o.level = level;
    o.stick = stick;
    o.full = varies_;
    o.e = f.p0;
    o.p1 = scaled(f.p1, h);
    if (!varies_) {
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

  /// Operators of constant step lengths are kept; those of located instants (h carries derivatives) are made anew.
  const Operators& operators(const S& h, int level, bool stick) {
    const double length = value_of(h);
    if (searching_ || !is_constant(h)) {
      make_operators(passing_, h, level, stick);
      return passing_;
    }
    for (Operators& o : kept_) {
      if (std::abs(o.h - length) <= 1e-9 * length && o.level == level && o.stick == stick) return o;
    }
    Operators& slot = kept_[static_cast<std::size_t>(next_kept_)];
    next_kept_ = (next_kept_ + 1) % static_cast<int>(kept_.size());
    make_operators(slot, S(length), level, stick);
    return slot;
  }

  /// A winding that has become faster than R/L (saturation, brush contact) is linearised at R 2^level, which keeps the
  /// remainder stable.
  int choose_level(const State& s) const {
    if (kind == Kind::axis || !electrical_) return 0;
    const Terms<S> t = terms_of(s, s.position);
    const double ratio =
        (value_of(t.resistance) + t.drop_slope / value_of(motor_[resistance])) / value_of(t.inductance);
    return ratio > 1.3 ? std::min(12, static_cast<int>(std::ceil(std::log2(ratio)))) : 0;
  }

  int step_count(const State& s, double h) const {
    if (!rates_) return 1;
    Terms<S> t;
    const Vector f = nonlinear(s, s.position, 0, t);
    const double acceleration = std::abs(value_of(f[w]) + value_of(linear_acceleration(s)));
    double rate = 0.0;
    const Motion<S> x = motion_of(s, s.position);
    for (int k = 0; k < count_; ++k) {
      if (effects_[k].call.rate != nullptr) {
        rate = std::max(rate, effects_[k].call.rate(effects_[k].p, motor_, x, acceleration));
      }
    }
    return std::clamp(static_cast<int>(std::ceil(h * rate / 0.7)), 1, 32);
  }

  State step(const State& s, const S& h) { return varies_ ? nonlinear_step(s, h) : linear_step(s, h); }

  State linear_step(const State& s, const S& h) {
    State next = s;
    linear_update(s, h, next.x, next.position);
    if (finishes_) finish(s, next, h);
    return next;
  }

  /// Exact solution over h for constant terms; `x` and `position` may be those of `s`.
  void linear_update(const State& s, const S& h, Vector& x, S& position) {
    const Operators& o = operators(h, 0, dry_ && s.direction == 0.0);
    const Vector f = constant_part(s);
    Vector after{};
    add_product<S, n>(after, o.e, s.x);
    add_product<S, n>(after, o.p1, f);
    S travelled = s.position;
    for (std::size_t j = 0; j < n; ++j) travelled += o.p1[w * n + j] * s.x[j] + o.p2[w * n + j] * f[j];
    x = after;
    position = travelled;
  }

  State nonlinear_step(const State& s, const S& h) {
    const bool stick = dry_ && s.direction == 0.0;
    const int level = choose_level(s);
    const Operators& o = operators(h, level, stick);
    const S& start = s.position;
    Terms<S> t0, ta, tb, tc;
    const Vector f0 = nonlinear(s, start, level, t0);
    State a = stage(s, o.eh, s.x, o.p1h, f0, 0.5 * h, s.x[w], t0);
    const Vector fa = nonlinear(a, start, level, ta);
    State b = stage(s, o.eh, s.x, o.p1h, fa, 0.5 * h, a.x[w], ta);
    const Vector fb = nonlinear(b, start, level, tb);
    Vector mixed = fb;
    for (std::size_t j = 0; j < n; ++j) mixed[j] = 2.0 * fb[j] - f0[j];
    State c = stage(s, o.eh, a.x, o.p1h, mixed, h, b.x[w], tb);
    const Vector fc = nonlinear(c, start, level, tc);

    State next = s;
    next.x = Vector{};
    add_product<S, n>(next.x, o.e, s.x);
    add_product<S, n>(next.x, o.f1, f0);
    for (std::size_t j = 0; j < n; ++j) mixed[j] = fa[j] + fb[j];
    add_product<S, n>(next.x, o.f2, mixed);
    add_product<S, n>(next.x, o.f3, fc);
    const S sixth = h / 6.0;
    next.position += sixth * (s.x[w] + 2.0 * (a.x[w] + b.x[w]) + c.x[w]);
    if (hiddens_) {
      for (std::size_t k = 0; k < next.hidden.size(); ++k) {
        next.hidden[k] +=
            sixth * (t0.hidden_rate[k] + 2.0 * (ta.hidden_rate[k] + tb.hidden_rate[k]) + tc.hidden_rate[k]);
      }
    }
    if (finishes_) finish(s, next, h);
    return next;
  }

  State stage(const State& s, const Matrix& e, const Vector& from, const Matrix& p1, const Vector& f, const S& h,
              const S& speed, const Terms<S>& t) const {
    State r = s;
    r.x = Vector{};
    add_product<S, n>(r.x, e, from);
    add_product<S, n>(r.x, p1, f);
    r.position += h * speed;
    if (hiddens_) {
      for (std::size_t k = 0; k < r.hidden.size(); ++k) r.hidden[k] += h * t.hidden_rate[k];
    }
    return r;
  }

  void finish(const State& before, State& after, const S& h) const {
    const Motion<S> x0 = motion_of(before, before.position);
    const Motion<S> x1 = motion_of(after, before.position);
    for (int k = 0; k < count_; ++k) {
      if (effects_[k].call.finish != nullptr) {
        effects_[k].call.finish(effects_[k].p, motor_, h, x0, x1, after.memory.data() + effects_[k].memory);
      }
    }
  }

  // ---- dry friction -------------------------------------------------------------------------------------------------

  void advance_with_friction(State& s, S left) {
    if (!varies_ && !finishes_ && s.direction != 0.0) {  // the common case: it goes on sliding
      Vector x;
      S position;
      linear_update(s, left, x, position);
      if (s.direction * value_of(x[w]) >= 0.0) {
        s.x = x;
        s.position = position;
        return;
      }
    }
    const double whole = value_of(left);
    for (int guard = 0; guard < 40 && value_of(left) > 1e-12 * whole; ++guard) {
      if (s.direction == 0.0) decide(s);
      const int steps = guard < 39 ? step_count(s, value_of(left)) : 1;
      const S h = steps == 1 ? left : left / static_cast<double>(steps);
      for (int k = 0; k < steps; ++k) {
        State next = step(s, h);
        if (s.direction != 0.0 ? s.direction * value_of(next.x[w]) >= 0.0 : breaking(next) == 0.0) {
          s = next;
          left -= h;
          continue;
        }
        left -= s.direction != 0.0 ? stop(s, h) : break_away(s, h, breaking(next));
        break;
      }
    }
  }

  /// Sliding direction that the torque on a standing shaft leads to; 0 while friction holds.
  double breaking(State s) const {
    for (double direction : {1.0, -1.0}) {
      if (excess(s, direction) > 0.0) return direction;
    }
    return 0.0;
  }

  /// Torque beyond the friction level in `direction`, as a number.
  double excess(State s, double direction) const { return value_of(excess_torque(s, direction)); }

  S excess_torque(State s, double direction) const {
    s.direction = direction;
    const Terms<S> t = terms_of(s, s.position);
    return direction * standing_torque(s, t) - t.friction;
  }

  void decide(State& s) const { s.direction = breaking(s); }

  /// Sliding that comes to rest within h: puts the state there; returns the time it took.
  S stop(State& s, const S& h) {
    if (value_of(s.x[w]) == 0.0) {  // could not start: the friction holds after all
      s.direction = 0.0;
      s = step(s, h);
      s.x[w] = S(0.0);
      return h;
    }
    const double direction = s.direction;
    const double instant = root(value_of(h), [&](double tau) { return direction * value_of(step(s, S(tau)).x[w]); });
    const State there = step(s, S(instant));
    Terms<S> t;
    const Vector f = nonlinear(there, there.position, 0, t);
    const double acceleration = value_of(f[w]) + value_of(linear_acceleration(there));
    const S duration = shifted(instant, there.x[w], acceleration);
    s = step(s, duration);
    s.x[w] = S(0.0);
    s.direction = 0.0;
    decide(s);
    return duration;
  }

  /// Sticking that gives way within h: puts the state at that instant; returns the time it took.
  S break_away(State& s, const S& h, double direction) {
    const auto margin = [&](double tau) { return -excess(step(s, S(tau)), direction); };
    const double instant = root(value_of(h), margin);
    const double nudge = 1e-6 * value_of(h);
    const double slope = (margin(instant) - margin(instant + nudge)) / nudge;
    const S duration = shifted(instant, excess_torque(step(s, S(instant)), direction), slope);
    s = step(s, duration);
    s.x[w] = S(0.0);
    s.direction = direction;
    return duration;
  }

  /// The instant with its derivatives, by the implicit function theorem: g(tau, p) = 0.
  static S shifted(double instant, const S& g, double slope) {
    S tau(instant);
    if (std::abs(slope) > 1e-300) tau -= (g - value_of(g)) / slope;
    return tau;
  }

  /// Root of g on (0, h], g(0) >= 0 > g(h), by the Illinois method.
  template <class G>
  double root(double h, const G& g) {
    searching_ = true;  // its steps are not worth keeping
    const double found = illinois(h, g);
    searching_ = false;
    return found;
  }

  template <class G>
  static double illinois(double h, const G& g) {
    double low = 0.0, high = h, at_low = g(0.0), at_high = g(h);
    double mid = h;
    for (int k = 0; k < 60 && high - low > 1e-13 * h; ++k) {
      mid = (at_low * high - at_high * low) / (at_low - at_high);
      if (!(mid > low && mid < high)) mid = 0.5 * (low + high);
      const double at_mid = g(mid);
      if (at_mid == 0.0) return mid;
      if ((at_mid > 0.0) == (at_low >= 0.0)) {
        low = mid;
        at_low = at_mid;
        at_high *= 0.5;
      } else {
        high = mid;
        at_high = at_mid;
        at_low *= 0.5;
      }
    }
    return mid;
  }

  const Motor<S>& motor_;
  const ActiveEffect<S>* effects_;
  int count_;
  double angle_per_position_;
  bool varies_ = false, dry_ = false, hiddens_ = false, finishes_ = false, pendulum_ = false, electrical_ = false,
       rates_ = false, timed_ = false, searching_ = false;
  S base_friction_{}, inverse_inertia_{}, inverse_inductance_{};
  S input_{};
  double time_ = 0.0, offset_ = 0.0;
  std::array<S, 3> constants_{};  // constant acceleration when sliding back, standing, sliding forth
  std::array<bool, 3> constants_known_{};
  std::array<Operators, 6> kept_{};
  int next_kept_ = 0;
  Operators passing_{};
};

}  // namespace rwn
