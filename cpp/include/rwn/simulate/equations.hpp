// The equations of motor.hpp as functions of the state, with whatever effects are switched on.
#pragma once

#include <algorithm>
#include <cmath>

#include "rwn/simulate/by_direction.hpp"
#include "rwn/simulate/division.hpp"
#include "rwn/simulate/drive_torque.hpp"
#include "rwn/simulate/effect_terms.hpp"
#include "rwn/simulate/second_mass.hpp"
#include "rwn/simulate/winding_level.hpp"

namespace rwn {

template <class S, class Drive, int masses>
class Equations {
 public:
  using Moving = MovingState<S, Drive, masses>;
  using State = DriveState<S, Drive, masses>;
  static constexpr int n = State::n;
  static constexpr std::size_t w = State::w;
  using Torque = DriveTorque<S, Drive>;
  using Vector = SmallVector<S, n>;
  using Matrix = SmallMatrix<S, n>;

  Equations(const Motor<S>& motor, const ActiveEffect<S>* effects, int count, double angle_per_position)
      : motor_(motor), electrics_(motor), effects_(motor, electrics_, effects, count, angle_per_position) {
    bool replaced = false;
    for (int k = 0; k < count; ++k) {
      const auto& call = effects[k].call;
      varies_ = varies_ || call.varies;
      dry_ = dry_ || call.dry;
      winds_ = winds_ || (call.electrical && call.varies);
      settles_ = settles_ || (Drive::states > 0 && call.varies && (call.electrical || call.loaded));
      rates_ = rates_ || settles_ || call.rate != nullptr || (effects[k].own != nullptr && call.varies);
      timed_ = timed_ || call.breaks != nullptr;
      replaced = replaced || call.replaces;
      finishes_ = finishes_ || call.finish != nullptr;
      if constexpr (masses == 2) {
        if (call.joint != nullptr) second_ = SecondMass<S, Drive>(call.joint(effects[k].p, motor_), motor_);
      }
    }
    base_friction_ = replaced ? S(0.0) : motor_[coulomb_friction];
    dry_ = dry_ || (!replaced && is_used(motor_[coulomb_friction]));
    pendulum_ = is_used(motor_[pendulum_torque]);
    varies_ = varies_ || pendulum_;
    inertia_ = motor_[inertia];
    viscous_ = motor_[viscous_friction];
    if constexpr (masses == 2) {
      inertia_ = second_.first_inertia();
      viscous_ = second_.first_viscous(motor_);
    }
    inverse_inertia_ = 1.0 / inertia_;
  }

  /// Whether the motor keeps an inertia of its own in front of a joint.
  bool sound() const { return value_of(inertia_) > 0.0 && second_.sound(); }

  bool varies() const { return varies_; }      // within a step, other than with the direction of sliding
  bool rates() const { return rates_; }        // something asks for short steps
  bool dry() const { return dry_; }            // there is friction that holds
  bool finishes() const { return finishes_; }  // effects have memories that follow the motion

  /// Whether the equation of the winding is another than R, L and Ke make it.
  bool electrical() const { return Drive::states > 0 && winds_; }

  /// A gap opens and closes.
  bool plays() const { return second_.play(); }

  /// Input and time (middle of the interval) of what is integrated next.
  void begin(const S& input, double time) {
    effects_.begin(input, time);
    if (timed_) constants_.forget();
  }

  /// Recorded minus simulated position, where angle-dependent effects follow the recorded one.
  void follow(const S& offset) { effects_.follow(offset); }

  /// What stands before the shaft.
  const auto& electrics() const { return electrics_; }

  /// The mass behind a joint, where there are two.
  const auto& second() const { return second_; }

  Regime regime(const Moving& s, int level) const { return {level, sticks(s), masses == 2 && s.contact != 0.0}; }

  /// A of the linear part.
  Matrix system_matrix(const Regime& regime) const {
    Matrix a{};
    if constexpr (Drive::states > 0) {
      const bool stick = regime.stick() && !second_.drives();
      electrics_.couple(a.data(), n, driven(), resistances_of(regime.level()), inverse_driven(), stick);
    }
    if (!regime.stick()) a[w * n + w] = -(viscous_ * inverse_inertia_);
    if constexpr (masses == 2) second_.couple(a, regime);
    return a;
  }

  /// A winding that has become faster than R/L (saturation, brush contact) is linearised at R 2^level, which keeps the
  /// remainder stable; `t` are the terms at s. Where its transient is over within h, so is that of where it settles.
  int choose_level(const State& s, const Terms<S>& t, double h) {
    if constexpr (Drive::states > 0) {
      if (!electrical()) return 0;
      double ratio = speed_up(s, t);
      if (h * electrics_.rate(t) > angle_of_a_winding) {
        const State there = electrics_.settled(s, s.x[driven()], input());
        ratio = std::max(ratio, speed_up(there, terms_of(there, s.position)));
      }
      return level_of(ratio);
    }
    return 0;
  }

  /// The steps that the effects ask for over h, where `f` and `t` are those of its start (level 0). Where one of
  /// them changes with the current, the winding's transient is followed, in steps of lengths that come back.
  Division divide(const State& s, double h, const Vector& f, const Terms<S>& t) {
    double acceleration = std::abs(value_of(f[w]) + value_of(linear_acceleration(s)));
    if constexpr (Drive::states > 0) {
      const State there = electrics_.settled(s, s.x[driven()], input());  // the current may get there within h
      acceleration = std::max(acceleration, std::abs(value_of(f[w]) + value_of(linear_acceleration(there))));
      const double rate = electrics_.rate({});
      if (settles_ && h * rate > angle_of_a_slow_winding && !electrics_.is_settled(s.x, s.x[driven()], f, t)) {
        const double fastest = std::max(electrics_.rate(t), electrics_.rate(terms_of(there, s.position)));
        return {h, effects_.rate(s, acceleration, h), rate, level_of(fastest / rate)};
      }
    }
    return {h, effects_.rate(s, acceleration, h)};
  }

  /// dx/dt - A x, with A of level `level`; `start` is the position at the start of the step. Fills `t`.
  RWN_INLINE Vector nonlinear(const Moving& s, const S* memory, const S& start, int level, Terms<S>& t) {
    put_terms(t, s, memory, start);
    Vector f{};
    if constexpr (masses == 2) f[State::speed_behind] = second_.constant_torque(s) * second_.inverse_behind();
    if constexpr (Drive::states > 0) {
      winds_ ? electrics_.remainder(f, s.x, s.x[driven()], t, input(), resistances_of(level))
             : electrics_.drive(f, input());
    }
    if (effects_.scales()) return accelerated(f, s, t);
    if (second_.drives()) f[driven()] += Torque::given(input()) * inverse_driven();
    if (sticks(s)) return f;
    S torque = t.torque;
    if (Drive::forced && !second_.drives()) torque += input();
    if (dry_) torque -= s.direction * t.friction;
    if constexpr (masses == 2) torque -= second_.constant_torque(s);
    f[w] = torque * inverse_inertia_;
    return f;
  }

  /// dx/dt - A x where no effect varies within a step: the terms depend on direction alone.
  Vector constant_part(const State& s) {
    const bool stick = sticks(s);
    Vector f = plain_part(stick ? S(0.0) : steady_acceleration(s), input());
    if (stick) f[w] = S(0.0);
    if constexpr (masses == 2) {
      const S torque = second_.constant_torque(s);
      f[State::speed_behind] += torque * second_.inverse_behind();
      if (!stick) f[w] -= torque * inverse_inertia_;
    }
    return f;
  }

  /// What accelerates a shaft that slides besides the input where no effect varies.
  S steady_acceleration(const State& s) { return constants(s, s.direction).acceleration; }

  /// `constant_part` of a single mass with that.
  Vector plain_part(const S& steady, const S& input) const {
    Vector f{};
    f[w] = steady;
    if constexpr (Drive::states > 0) electrics_.drive(f, input);
    if constexpr (Drive::forced) f[driven()] += input * inverse_driven();
    return f;
  }

  double acceleration(const State& s) {
    Terms<S> t;
    return value_of(nonlinear(s, s.memory.data(), s.position, 0, t)[w]) + value_of(linear_acceleration(s));
  }

  /// Torque on the shaft beyond the friction level in `direction`, were it to slide that way.
  S excess_torque(const State& s, double direction) {
    S load(0.0);
    if constexpr (masses == 2) load = second_.torque(s);
    if (!varies_) {
      const Constants& c = constants(s, direction);
      if (!second_.drives()) load -= Torque::linear(electrics_, s.x) + Torque::given(input());
      return direction * (c.torque - load) - c.friction;
    }
    State sliding = s;
    sliding.direction = direction;
    const Terms<S> t = terms_of(sliding, s.position);
    return direction * ((second_.drives() ? S(0.0) : drive_torque(sliding, t)) + t.torque - load) - t.friction;
  }

  /// Sliding direction that the torque on a standing shaft leads to; 0 while friction holds.
  double breaking(const State& s) {
    for (double direction : {1.0, -1.0}) {
      if (value_of(excess_torque(s, direction)) > 0.0) return direction;
    }
    return 0.0;
  }

  /// Torque by which friction holds a shaft beyond what pulls at it.
  double holding(const State& s) {
    return std::min(-value_of(excess_torque(s, 1.0)), -value_of(excess_torque(s, -1.0)));
  }

  /// What the equations leave over in a state whose speed changes by `acceleration` and whose current by `slope` [A/s].
  UnknownInputs<S> unknown(const State& s, double acceleration, double slope) {
    const Terms<S> t = terms_of(s, s.position);
    UnknownInputs<S> left;
    left.torque = (inertia_ + t.inertia) * acceleration - accelerating_torque(s, t);
    if constexpr (Drive::states > 0) left.voltage = electrics_.unknown_voltage(s.x, s.x[driven()], t, input(), slope);
    return left;
  }

  /// Lets the memories of effects follow a step of length h.
  void finish(const State& before, State& after, const S& h) { effects_.finish(before, after, h); }

 private:
  struct Constants {
    S torque{}, friction{}, acceleration{};
  };

  /// Place in x of the speed of the mass that the drive turns, and the inverse of its inertia.
  std::size_t driven() const { return second_.drives() ? State::speed_behind : w; }
  const S& inverse_driven() const { return second_.inverse_driven(inverse_inertia_); }
  S drive_torque(const Moving& s, const Terms<S>& t) const { return electrics_.torque(s.x, t.flux, input()); }
  bool sticks(const Moving& s) const { return dry_ && s.direction == 0.0; }
  const S& input() const { return effects_.input(); }

  /// How much faster than R/L the winding is in a state, whose terms are `t`.
  double speed_up(const State& s, const Terms<S>& t) {
    return electrics_.speed_up(t, t.drop_slope + effects_.own_drop_slope(s));
  }

  Terms<S> terms_of(const State& s, const S& start) {
    Terms<S> t;
    put_terms(t, s, s.memory.data(), start);
    return t;
  }

  RWN_INLINE void put_terms(Terms<S>& t, const Moving& s, const S* memory, const S& start) {
    using std::sin;
    effects_.renew(t, base_friction_);
    effects_.add(t, s, memory, start);
    if (pendulum_) t.torque -= motor_[pendulum_torque] * sin(s.position);
  }

  /// `f` with its accelerations, where the flux or the inertia is another than the linear part has.
  [[gnu::noinline]] Vector accelerated(Vector f, const Moving& s, const Terms<S>& t) const {
    if (second_.drives()) f[driven()] += (drive_torque(s, t) - Torque::linear(electrics_, s.x)) * inverse_driven();
    if (sticks(s)) return f;
    const S torque = accelerating_torque(s, t);
    const S whole = value_of(t.inertia) == 0.0 ? torque * inverse_inertia_ : torque / (inertia_ + t.inertia);
    f[w] = whole - linear_acceleration(s);
    return f;
  }

  /// What accelerates the motor's mass while it slides.
  S accelerating_torque(const Moving& s, const Terms<S>& t) const {
    S torque = (second_.drives() ? S(0.0) : drive_torque(s, t)) + t.torque - viscous_ * s.x[w];
    if constexpr (masses == 2) torque -= second_.torque(s);
    if (dry_) torque -= s.direction * t.friction;
    if (value_of(t.inertia_slope) != 0.0) torque -= 0.5 * t.inertia_slope * s.x[w] * s.x[w];
    return torque;
  }

  /// Terms of sliding in `direction` where they depend on nothing else; made once.
  const Constants& constants(const State& s, double direction) {
    return constants_.at(direction, [&]() -> Constants {
      State sliding = s;
      sliding.direction = direction;
      const Terms<S> t = terms_of(sliding, s.position);
      return {t.torque, t.friction, (t.torque - direction * t.friction) * inverse_inertia_};
    });
  }

  S linear_acceleration(const Moving& s) const {
    S torque = -(viscous_ * s.x[w]);
    if constexpr (masses == 2) {
      if (s.contact != 0.0) torque -= second_.spring(s);
    }
    if (!second_.drives()) torque += Torque::linear(electrics_, s.x);
    return torque * inverse_inertia_;
  }

  const Motor<S>& motor_;
  typename Drive::template Electrics<S> electrics_;
  EffectTerms<S, Drive, masses> effects_;
  bool varies_ = false, dry_ = false, finishes_ = false, pendulum_ = false, winds_ = false, rates_ = false,
       settles_ = false, timed_ = false;
  S base_friction_{}, inertia_{}, inverse_inertia_{};
  S viscous_{};  // of the first mass alone
  [[no_unique_address]] std::conditional_t<masses == 2, SecondMass<S, Drive>, NoSecondMass> second_{};
  ByDirection<Constants> constants_;
};

}  // namespace rwn
