// Formulas of users as programs of a stack machine, for any scalar: dual numbers carry the derivatives along.
#pragma once

#include <cmath>
#include <span>
#include <string_view>
#include <vector>

#include "rwn/model/motor.hpp"
#include "rwn/numerics/dual.hpp"
#include "rwn/numerics/room.hpp"
#include "rwn/model/wavelet_sum.hpp"

namespace rwn {

/// What a step of a program does. The first four push a value, the others act on the top of the stack; the last two are
/// no words of users, see `Formula`.
enum class Operation {
  number,
  variable,
  nominal,
  parameter,
  negate,
  add,
  subtract,
  multiply,
  divide,
  power,
  sin,
  cos,
  tan,
  atan,
  tanh,
  exp,
  log,
  sqrt,
  abs,
  sign,
  min,
  max,
  mexican_hat,
  curve,
  wavelet_sum
};
inline constexpr std::string_view operation_names[] = {
    "number", "variable", "nominal", "parameter", "negate", "add",  "subtract",   "multiply",
    "divide", "power",    "sin",     "cos",       "tan",    "atan", "tanh",       "exp",
    "log",    "sqrt",     "abs",     "sign",      "min",    "max",  "mexican_hat"};

/// What a formula knows of the motion.
enum class Variable { time, input, current, speed, position, direction, drive_torque };
inline constexpr std::string_view variable_names[] = {"time",     "input",     "current",     "speed",
                                                      "position", "direction", "drive_torque"};

/// One step: `number` is what it pushes, `place` the variable, nominal parameter or own parameter that it pushes. A
/// `curve` announces that the next `number` steps depend on the variable `place` alone; a `wavelet_sum` pushes the sum
/// of that place.
struct Instruction {
  Operation operation = Operation::number;
  double number = 0.0;
  int place = 0;
};

inline constexpr int formula_depth = 32;  // most values that are on the stack at once

/// Refuses a program that does not leave exactly one value, needs more than `formula_depth`, or reads a place that
/// does not exist. Throws std::invalid_argument.
void check_formula(std::span<const Instruction> program, int parameters);

/// A checked program in plain pointers, for kernels.
struct Program {
  const Instruction* steps = nullptr;
  int length = 0;
  const WaveletSum* sums = nullptr;
};

/// A checked program made quick: sums of wavelets are single steps, and what depends on one variable is announced as a
/// curve, which needs one derivative however many the result has.
struct Formula {
  std::vector<WaveletSum> sums;
  std::vector<Instruction> steps;

  explicit Formula(std::span<const Instruction> program);

  /// Points into this.
  Program plain() const { return {steps.data(), static_cast<int>(steps.size()), sums.data()}; }
};

/// `program` with sums of wavelets over one variable as single steps, which are put into `sums`.
std::vector<Instruction> with_sums(std::span<const Instruction> program, std::vector<WaveletSum>& sums);

/// `program`, whose sums are `sums`, with its curves announced.
std::vector<Instruction> with_curves(std::span<const Instruction> program, std::span<const WaveletSum> sums = {});

template <class S>
double direction_of(const Motion<S>& x) {
  if (x.direction != 0.0) return x.direction;
  const double speed = value_of(x.speed);  // without dry friction nobody keeps the direction of sliding
  return speed > 0.0 ? 1.0 : speed < 0.0 ? -1.0 : 0.0;
}

template <class S>
S variable_of(Variable v, const Motion<S>& x) {
  switch (v) {
    case Variable::time:
      return S(x.time);
    case Variable::input:
      return x.input;
    case Variable::current:
      return x.current;
    case Variable::speed:
      return x.speed;
    case Variable::position:
      return x.angle / x.angle_per_position;  // follows the recorded one where that is asked for
    case Variable::direction:
      return S(direction_of(x));
    case Variable::drive_torque:
      return x.drive_torque;
  }
  return S(0.0);
}

template <class S, class P>
S push(const Instruction& step, const P* p, const Motor<P>& motor, const Motion<S>& x) {
  switch (step.operation) {
    case Operation::number:
      return S(step.number);
    case Operation::variable:
      return variable_of(static_cast<Variable>(step.place), x);
    case Operation::nominal:
      return as_scalar<S>(motor[static_cast<std::size_t>(step.place)]);
    default:
      return as_scalar<S>(p[step.place]);
  }
}

template <class S>
void apply_to_one(Operation operation, S& a) {
  using std::abs, std::atan, std::cos, std::exp, std::log, std::sin, std::sqrt, std::tan, std::tanh;
  switch (operation) {
    case Operation::negate:
      a = -a;
      return;
    case Operation::sin:
      a = sin(a);
      return;
    case Operation::cos:
      a = cos(a);
      return;
    case Operation::tan:
      a = tan(a);
      return;
    case Operation::atan:
      a = atan(a);
      return;
    case Operation::tanh:
      a = tanh(a);
      return;
    case Operation::exp:
      a = exp(a);
      return;
    case Operation::log:
      a = log(a);
      return;
    case Operation::sqrt:
      a = sqrt(a);
      return;
    case Operation::abs:
      a = abs(a);
      return;
    case Operation::sign:
      a = S(value_of(a) > 0.0 ? 1.0 : value_of(a) < 0.0 ? -1.0 : value_of(a));
      return;
    default: {  // mexican_hat
      const double z = value_of(a), bell = std::exp(-0.5 * z * z);
      a = a.chain((1.0 - z * z) * bell, z * (z * z - 3.0) * bell);
    }
  }
}

template <class S>
void apply_to_two(Operation operation, S& a, const S& b) {
  using std::pow;
  switch (operation) {
    case Operation::add:
      a += b;
      return;
    case Operation::subtract:
      a -= b;
      return;
    case Operation::multiply:
      a *= b;
      return;
    case Operation::divide:
      a /= b;
      return;
    case Operation::power:
      a = value_of(b) == 2.0 && is_constant(b) ? a * a : pow(a, b);
      return;
    case Operation::min:
      if (value_of(b) < value_of(a) || std::isnan(value_of(b))) a = b;
      return;
    default:  // max
      if (value_of(b) > value_of(a) || std::isnan(value_of(b))) a = b;
  }
}

[[gnu::always_inline]] inline constexpr bool pushes(Operation o) { return o <= Operation::parameter; }
[[gnu::always_inline]] inline constexpr bool takes_two(Operation o) {
  return (o >= Operation::add && o <= Operation::power) || o == Operation::min || o == Operation::max;
}

/// a = a `operation` b for a number b, which has no slopes; false, and a as it was, where this has no short cut.
template <class S>
bool apply_number(Operation operation, S& a, double b) {
  switch (operation) {
    case Operation::add:
      a.v += b;
      return true;
    case Operation::subtract:
      a.v -= b;
      return true;
    case Operation::multiply:
      a *= b;
      return true;
    case Operation::divide:
      a = a.chain(a.v / b, 1.0 / b);
      return true;
    default:
      return false;
  }
}

/// Value of a checked program whose values `push` puts on the stack, which has room for `formula_depth`.
/// `curve_of`: value of the curve that begins at a step; `sum_of`: of a sum of wavelets.
template <class S, class Push, class CurveOf, class SumOf>
S run(const Instruction* program, int length, S* stack, const Push& push, const CurveOf& curve_of,
      const SumOf& sum_of) {
  S* top = stack;  // one past the last
  for (int k = 0; k < length; ++k) {
    const Instruction& step = program[k];
    const bool direct = step.operation == Operation::number && k > 0 && k + 1 < length;
    if (direct && apply_number(program[k + 1].operation, top[-1], step.number)) {
      ++k;
    } else if (step.operation == Operation::curve) {
      *top++ = curve_of(program + k);
      k += static_cast<int>(step.number);
    } else if (step.operation == Operation::wavelet_sum) {
      *top++ = sum_of(step);
    } else if (pushes(step.operation)) {
      *top++ = push(step);
    } else if (takes_two(step.operation)) {
      --top;
      apply_to_two(step.operation, top[-1], *top);
    } else {
      apply_to_one(step.operation, top[-1]);
    }
  }
  return stack[0];
}

/// Value of a curve at x, with the slopes of x times its own.
template <int N, class Isa>
Dual<N, Isa> curve_at(const Instruction* curve, const WaveletSum* sums, const Dual<N, Isa>& x) {
  using One = Dual<(N > 0), Isa>;
  Room<One, formula_depth> stack;
  const One at = One::variable(x.v, 0);
  const auto push = [&](const Instruction& step) {
    return step.operation == Operation::number ? One(step.number) : at;
  };
  const auto none = [](const Instruction*) { return One(0.0); };
  const auto sum_of = [&](const Instruction& step) { return sum_at(sums[step.place], at, &at); };
  const One y = run(curve + 1, static_cast<int>(curve->number), stack.numbers, push, none, sum_of);
  if constexpr (N == 0) return y;
  return x.chain(y.v, y.d[0]);
}

/// Value of a checked program; `stack` has room for `formula_depth`. p: the effect's own parameters; those and the
/// motor's count by their values where they are of another kind than the motion.
template <class S, class P>
S evaluate(const Program& program, const P* p, const Motor<P>& motor, const Motion<S>& x, S* stack) {
  const auto over = [&](int place) { return variable_of(static_cast<Variable>(place), x); };
  const auto pushed = [&](const Instruction& step) { return push(step, p, motor, x); };
  const auto curve_of = [&](const Instruction* curve) { return curve_at(curve, program.sums, over(curve->place)); };
  const auto sum_of = [&](const Instruction& step) {
    const WaveletSum& sum = program.sums[step.place];
    return sum_at(sum, over(sum.over), p);
  };
  return run(program.steps, program.length, stack, pushed, curve_of, sum_of);
}

}  // namespace rwn
