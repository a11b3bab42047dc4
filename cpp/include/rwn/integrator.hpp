// Integrates the drive equations over one interval of constant input: chooses the cheapest exact way.
#pragma once

#include "rwn/friction_events.hpp"

namespace rwn {

template <class S, Kind kind>
class Integrator {
 public:
  using State = DriveState<S, kind>;
  static constexpr int n = State::n;
  static constexpr std::size_t w = n - 1;  // index of speed in x

  Integrator(const Motor<S>& motor, const ActiveEffect<S>* effects, int count, double angle_per_position)
      : equations_(motor, effects, count, angle_per_position) {}
  Integrator(const Integrator&) = delete;  // its parts refer to each other
  Integrator& operator=(const Integrator&) = delete;

  /// Recorded minus simulated position, where angle-dependent effects follow the recorded one.
  void follow(const S& offset) { equations_.follow(offset); }

  /// Fixes sliding or sticking of a state that has just been set.
  void settle(State& s) const {
    if (dry_) s.direction = value_of(s.x[w]) > 0.0 ? 1.0 : value_of(s.x[w]) < 0.0 ? -1.0 : 0.0;
  }

  /// Advances `s` over `h` from time `time` with constant input.
  void advance(State& s, const S& h, const S& input, double time) {
    equations_.begin(input, time + 0.5 * value_of(h));
    if (!dry_) {
      exact_ ? stepper_.linear_update(s, h, s.x, s.position) : advance_smoothly(s, h);
    } else if (!exact_ || !keeps_on(s, h)) {
      advance_with_friction(s, h);
    }
  }

 private:
  void advance_smoothly(State& s, const S& h) {
    const int steps = stepper_.step_count(s, value_of(h));
    const S part = steps == 1 ? h : h / static_cast<double>(steps);
    for (int k = 0; k < steps; ++k) s = stepper_.step(s, part);
  }

  /// The common cases of constant terms, done where it returns true: the whole interval slides or stands.
  bool keeps_on(State& s, const S& h) {
    if (s.direction == 0.0) {
      s.direction = equations_.breaking(s);
      if constexpr (kind == Kind::axis) {
        if (s.direction == 0.0) return true;
      }
    }
    if (s.direction == 0.0) return false;
    typename Equations<S, kind>::Vector x;
    S position;
    stepper_.linear_update(s, h, x, position);
    if (!(s.direction * value_of(x[w]) >= 0.0)) return false;
    s.x = x;
    s.position = position;
    return true;
  }

  void advance_with_friction(State& s, S left) {
    const double whole = value_of(left);
    for (int guard = 0; guard < 40 && value_of(left) > 1e-12 * whole; ++guard) {
      if (s.direction == 0.0) s.direction = equations_.breaking(s);
      const int steps = guard < 39 ? stepper_.step_count(s, value_of(left)) : 1;
      const S h = steps == 1 ? left : left / static_cast<double>(steps);
      for (int k = 0; k < steps; ++k) {
        const State next = stepper_.step(s, h);
        if (!events_.continues(s, next)) {
          left -= events_.pass(s, h, next);
          break;
        }
        s = next;
        left -= h;
      }
    }
  }

  Equations<S, kind> equations_;
  Stepper<S, kind> stepper_{equations_};
  FrictionEvents<S, kind> events_{equations_, stepper_};
  const bool dry_ = equations_.dry();
  const bool exact_ = !equations_.varies() && !equations_.finishes();  // constant terms: one step whatever its length
};

}  // namespace rwn
