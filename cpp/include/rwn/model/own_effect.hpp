// An effect that a user defines: a formula for one term of the motor equations. The definition travels with the task of
// a simulation, so that several models can run at once; here is how it attaches to the equations, for any scalar.
#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "rwn/model/formula.hpp"
#include "rwn/numerics/room.hpp"

namespace rwn {

inline constexpr int max_own_effects = 6;
inline constexpr int max_own_parameters = 8;  // of one effect

/// What the formula is; the equation is that of motor.hpp.
enum class Term { torque, friction, load, drop, resistance, flux, inductance, input, current, speed, position };
inline constexpr std::string_view term_names[] = {"torque",     "friction", "load",    "drop",  "resistance", "flux",
                                                  "inductance", "input",    "current", "speed", "position"};

/// A definition in plain pointers, for kernels.
struct OwnProgram {
  Term term = Term::torque;
  Program program;
  int parameters = 0;
  bool varies = true;  // within a step, other than with the direction of sliding
};

/// A definition as a task carries it.
struct OwnEffect {
  Term term = Term::torque;
  Formula formula;
  int parameters = 0;

  /// Throws std::invalid_argument for a program that `check_formula` refuses, or too many parameters.
  OwnEffect(Term t, std::span<const Instruction> program, int count);

  /// Whether it changes within a step, other than with the direction of sliding.
  bool varies() const;

  /// Points into this.
  OwnProgram plain() const;
};

[[gnu::always_inline]] inline constexpr bool is_factor(Term t) {
  return t == Term::resistance || t == Term::flux || t == Term::inductance;
}
[[gnu::always_inline]] inline constexpr bool is_torque(Term t) { return t <= Term::load; }
[[gnu::always_inline]] inline constexpr bool is_sensor(Term t) { return t >= Term::current; }

/// A number with derivatives by current, speed and position, of the same instruction set as S.
template <class S>
struct PartialsOf;
template <int N, class Isa>
struct PartialsOf<Dual<N, Isa>> {
  using type = Dual<3, Isa>;
};

/// One own effect that is switched on.
template <class S>
class ActiveOwnEffect {
 public:
  ActiveOwnEffect() = default;
  /// `stack`: room for formula_depth; `failed` is set where the formula gives no finite number.
  ActiveOwnEffect(const OwnProgram& program, S* stack, bool* failed)
      : program_(program), stack_(stack), failed_(failed) {}

  Term term() const { return program_.term; }
  bool varies() const { return program_.varies; }

  /// The formula's value; where it has none, one that changes nothing, and the run is marked as failed.
  S value(const S* p, const Motor<S>& motor, const Motion<S>& x) const {
    S y = evaluate(program_.program, p, motor, x, stack_);
    y.clear_wild_slopes();
    if (std::isfinite(value_of(y))) return y;
    *failed_ = true;
    return S(is_factor(term()) ? 1.0 : 0.0);
  }

  /// Its share of the motor equations.
  void apply(const S* p, const Motor<S>& motor, const Motion<S>& x, Terms<S>& t) const {
    switch (term()) {
      case Term::torque:
      case Term::load:
        t.torque += value(p, motor, x);
        return;
      case Term::friction: {  // a level: negative ones would drive
        const S level = value(p, motor, x);
        if (value_of(level) > 0.0) t.friction += level;
        return;
      }
      case Term::drop:
        t.drop += value(p, motor, x);
        return;
      case Term::resistance:
        t.resistance *= value(p, motor, x);
        return;
      case Term::flux:
        t.flux *= value(p, motor, x);
        return;
      case Term::inductance:
        t.inductance *= value(p, motor, x);
        return;
      default:  // actuators and sensors are no terms of the equations
        return;
    }
  }

  /// Change of the voltage drop with the current; 0 where it is another term.
  double drop_slope(const S* p, const Motor<S>& motor, const Motion<S>& x) const {
    return term() == Term::drop ? partials(p, motor, x).d[0] : 0.0;
  }

  /// What is recorded in place of one true signal of `y`, as the sensors before this one show it.
  void sense(const S* p, const Motor<S>& motor, Motion<S> x, Reading<S>& y) const {
    S& signal = term() == Term::current ? y.current : term() == Term::speed ? y.speed : y.position;
    if (term() == Term::current) x.current = signal;
    if (term() == Term::speed) x.speed = signal;
    if (term() == Term::position) x.angle = signal * x.angle_per_position;
    signal = value(p, motor, x);
  }

  /// Fastest rate of change that it brings over the next h [1/s]: how stiff it is, and how far it bends along the way.
  double rate(const S* p, const Motor<S>& motor, const Motion<S>& x, double acceleration, double h) const {
    double stiffness = 0.0, bend = 0.0, size = 0.0;
    for (int k = 0; k < 3; ++k) {
      const Partials y = partials(p, motor, moved(x, acceleration, 0.5 * k * h));
      if (!std::isfinite(y.v)) return 0.0;
      size = std::max(size, std::abs(y.v));
      bend += (k == 1 ? -2.0 : 1.0) * y.v;
      if (is_torque(term())) {
        const double inverse = 1.0 / value_of(motor[inertia]);
        stiffness = std::max(stiffness, std::abs(y.d[1]) * inverse);
        stiffness = std::max(stiffness, std::sqrt(std::abs(y.d[2]) * inverse));
      }
    }
    // a sine whose phase moves by f over h bends by f^2 / 4 of its size
    const double turning = size > 0.0 ? 2.0 * std::sqrt(std::abs(bend) / size) / h : 0.0;
    return std::isfinite(stiffness) ? std::max(stiffness, turning) : turning;
  }

 private:
  using Partials = typename PartialsOf<S>::type;

  static Motion<S> moved(Motion<S> x, double acceleration, double tau) {
    x.angle += x.angle_per_position * tau * (value_of(x.speed) + 0.5 * acceleration * tau);
    x.speed += acceleration * tau;
    return x;
  }

  /// Value and derivatives by current, speed and position.
  Partials partials(const S* p, const Motor<S>& motor, const Motion<S>& x) const {
    Motion<Partials> at;
    at.time = x.time;
    at.direction = x.direction;
    at.input = value_of(x.input);
    at.current = Partials::variable(value_of(x.current), 0);
    at.speed = Partials::variable(value_of(x.speed), 1);
    at.angle = x.angle_per_position * Partials::variable(value_of(x.angle) / x.angle_per_position, 2);
    at.angle_per_position = x.angle_per_position;
    at.drive_torque = value_of(x.drive_torque);
    Room<Partials, formula_depth> stack;
    return evaluate(program_.program, p, motor, at, stack.numbers);
  }

  OwnProgram program_;
  S* stack_ = nullptr;
  bool* failed_ = nullptr;
};

}  // namespace rwn
