// A linear transfer function of any order from the input to the measured output,
//
//   G(s) = (b_{n-1} s^{n-1} + ... + b_0) / (s^n + a_{n-1} s^{n-1} + ... + a_0),
//
// in observer form: x_1' = x_2 - a_{n-1} x_1 + b_{n-1} u, ..., x_n' = -a_0 x_1 + b_0 u, y = x_1. The input is constant
// over each interval, so the step is exact: one exponential of the matrix ((A, b), (0, 0)). It takes the place of the
// drive's integrator; actuator and sensor effects attach to it as to a motor.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "rwn/simulate/active_effects.hpp"
#include "rwn/model/memory.hpp"
#include "rwn/numerics/room.hpp"
#include "rwn/simulate/step_counts.hpp"

namespace rwn {

inline constexpr int max_order = 20;

/// Place of the coefficients and the initial state behind the parameters of motor and effects.
enum Coefficient : int { numerator = 0, denominator = max_order, initial_state = 2 * max_order };
inline constexpr int coefficient_count = 3 * max_order;

template <class S>
class TransferFunction {
 public:
  static constexpr std::size_t w = 0;  // the measured output in x
  static constexpr int n = 2;          // states, as far as costs go

  struct State {
    std::array<S, max_order> x{};  // scaled: x_i / rate^{i-1}
    S position{};                  // not modelled
    Memory<S> memory{};
  };

  /// `coefficients`: `coefficient_count` values in the order of `Coefficient`.
  TransferFunction(const S* coefficients, int order, const ActiveEffect<S>* effects, int count)
      : coefficients_(coefficients), order_(order), effects_(effects), count_(count) {
    for (int i = 1; i <= order_; ++i) {
      rate_ = std::max(rate_, std::pow(std::abs(value_of(coefficient(denominator, i))), 1.0 / i));
    }
    if (!(rate_ > 0.0)) rate_ = 1.0;
  }

  State initial() const {
    State s;
    for (int i = 0; i < order_; ++i) s.x[at(i)] = coefficients_[initial_state + i] * std::pow(rate_, -i);
    return s;
  }

  bool sound() const { return true; }
  const StepCounts& counts() const { return counts_; }
  void settle(State&) const {}
  void follow(const S&) {}

  /// Advances `s` over `h` with constant input.
  void advance(State& s, const S& h, const S& input, double) {
    ++counts_.linear;
    const Matrix& m = step_of(h).m;
    Room<S, max_order> before;
    for (int i = 0; i < order_; ++i) before[at(i)] = s.x[at(i)];
    for (int i = 0; i < order_; ++i) {
      S sum = m[place(i, order_)] * input;
      for (int j = 0; j < order_; ++j) sum += m[place(i, j)] * before[at(j)];
      s.x[at(i)] = sum;
    }
    finish(before[w], s, h);
  }

 private:
  /// Of the highest order; a lower one uses the beginning.
  using Matrix = Room<S, static_cast<std::size_t>((max_order + 1) * (max_order + 1))>;
  struct Step {
    S h{-1.0};
    Matrix m;
  };

  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  std::size_t place(int i, int j) const { return static_cast<std::size_t>(i * (order_ + 1) + j); }

  /// Coefficient of s^{order - i} of numerator or denominator.
  const S& coefficient(Coefficient which, int i) const { return coefficients_[which + order_ - i]; }

  void finish(const S& before, State& after, const S& h) const {
    Motion<S> first, last;
    first.speed = before;
    last.speed = after.x[w];
    const Motor<S> none{};
    for (int k = 0; k < count_; ++k) {
      const auto& call = effects_[k].call;
      if (call.finish != nullptr)
        call.finish(effects_[k].p, none, h, first, last, after.memory.data() + effects_[k].memory);
    }
  }

  /// The last few steps are kept; a late input, whose instants carry a derivative, divides every sample alike.
  const Step& step_of(const S& h) {
    const double length = value_of(h);
    for (const Step& s : kept_) {
      if (std::abs(value_of(s.h) - length) <= 1e-9 * length && same_slopes(s.h, h)) return s;
    }
    Step& slot = kept_[at(next_)];
    next_ = (next_ + 1) % static_cast<int>(kept_.size());
    exponential(slot.m, h);
    slot.h = h;
    return slot;
  }

  /// exp(h ((A, b), (0, 0))) in the scaled states, by Taylor series, scaling and squaring.
  void exponential(Matrix& result, const S& h) {
    const double size = rate_ * std::abs(value_of(h)) * 3.0;  // rows of the scaled matrix hold at most three ones
    const int doublings = size > 0.5 ? static_cast<int>(std::ceil(std::log2(size / 0.5))) : 0;
    const S unit = std::ldexp(rate_, -doublings) * h;
    for (int i = 0; i <= order_; ++i) {
      for (int j = 0; j <= order_; ++j) z_[place(i, j)] = S(0.0);
    }
    for (int i = 0; i < order_; ++i) {
      const double power = std::pow(rate_, -(i + 1));
      z_[place(i, 0)] = -(coefficient(denominator, i + 1) * power) * unit;
      if (i + 1 < order_) z_[place(i, i + 1)] += unit;
      z_[place(i, order_)] = coefficient(numerator, i + 1) * power * unit;
    }
    identity(result, 1.0);
    for (int k = terms; k >= 1; --k) {  // Horner: I + z/1 (I + z/2 (...))
      multiply(result, z_, result, 1.0 / k);
      for (int i = 0; i <= order_; ++i) result[place(i, i)] += S(1.0);
    }
    for (int k = 0; k < doublings; ++k) {
      multiply(result, result, result, 1.0);
    }
  }

  void identity(Matrix& m, double value) const {
    for (int i = 0; i <= order_; ++i) {
      for (int j = 0; j <= order_; ++j) m[place(i, j)] = S(i == j ? value : 0.0);
    }
  }

  /// c = factor a b; c may be a or b.
  void multiply(Matrix& c, const Matrix& a, const Matrix& b, double factor) {
    for (int i = 0; i <= order_; ++i) {
      for (int j = 0; j <= order_; ++j) {
        S sum = a[place(i, 0)] * b[place(0, j)];
        for (int k = 1; k <= order_; ++k) sum += a[place(i, k)] * b[place(k, j)];
        scratch_[place(i, j)] = factor * sum;
      }
    }
    for (std::size_t k = 0; k < place(order_ + 1, 0); ++k) c[k] = scratch_[k];
  }

  static constexpr int terms = 14;  // of the series; 0.5^15 / 15! is far below rounding

  const S* coefficients_;
  int order_;
  const ActiveEffect<S>* effects_;
  int count_;
  double rate_ = 0.0;  // time scale that makes the coefficients of order one
  std::array<Step, 4> kept_{};
  int next_ = 0;
  StepCounts counts_;
  Matrix z_, scratch_;
};

}  // namespace rwn
