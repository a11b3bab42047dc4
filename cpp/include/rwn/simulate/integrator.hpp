// Integrates the drive equations over one interval of constant input: chooses the cheapest exact way.
#pragma once

#include "rwn/simulate/events.hpp"

namespace rwn {

template <class S, class Drive, int masses>
class Integrator {
 public:
  using State = DriveState<S, Drive, masses>;
  static constexpr std::size_t w = State::w;
  static constexpr int n = State::n;

  Integrator(const Motor<S>& motor, const ActiveEffect<S>* effects, int count, double angle_per_position)
      : equations_(motor, effects, count, angle_per_position) {}
  Integrator(const Integrator&) = delete;  // its parts refer to each other
  Integrator& operator=(const Integrator&) = delete;

  /// Recorded minus simulated position, where angle-dependent effects follow the recorded one.
  void follow(const S& offset) { equations_.follow(offset); }

  /// False where no motion follows from the equations.
  bool sound() const { return equations_.sound(); }

  /// The electrical part begins as the parameters say, a second mass with the first.
  void begin(State& s) const {
    equations_.electrics().begin(s.x);
    if constexpr (masses == 2) equations_.second().begin(s);
  }

  /// Fixes sliding or sticking, and contact, of a state that has just been set.
  void settle(State& s) const {
    events_.settle(s);
    if (dry_) s.direction = value_of(s.x[w]) > 0.0 ? 1.0 : value_of(s.x[w]) < 0.0 ? -1.0 : 0.0;
  }

  /// Of all steps so far.
  const StepCounts& counts() const { return stepper_.counts(); }

  /// Advances `s` over `h` from time `time` with constant input.
  void advance(State& s, const S& h, const S& input, double time) {
    equations_.begin(input, time + 0.5 * value_of(h));
    if (exact_ && keeps_on(s, h)) return;
    dry_ || play_ ? advance_with_events(s, h) : advance_smoothly(s, h);
  }

  /// Whether nothing but friction happens between samples: constant terms, one mass.
  bool plain() const { return masses == 1 && exact_; }
  bool dry() const { return dry_; }

  /// In a run that is `plain`: what accelerates a shaft that slides in `s.direction`, besides the input.
  S steady_acceleration(const State& s) { return equations_.steady_acceleration(s); }

  /// In a run that is `plain`: advances a sliding shaft, or returns false where it would stop. `dry`: with friction.
  template <bool dry>
  bool slides_on(typename State::Moving& s, double h, const S& steady, const S& input) {
    if constexpr (!dry) {
      stepper_.plain_update(s.x, s.position, h, steady, input);
      return true;
    }
    if (s.direction == 0.0) return false;
    auto x = s.x;
    S position = s.position;
    stepper_.plain_update(x, position, h, steady, input);
    if (s.direction * value_of(x[w]) < 0.0) return false;
    s.x = x;
    s.position = position;
    return true;
  }

 private:
  void advance_smoothly(State& s, const S& h) {
    const Division parts = stepper_.divide(s, value_of(h));
    for (int k = 0; k < parts.count(); ++k) s = stepper_.step(s, parts.length(k, h));
  }

  /// Advances under constant terms in one step; false, with nothing advanced, where an event may lie within h.
  bool keeps_on(State& s, const S& h) {
    if (dry_ && s.direction == 0.0) {
      s.direction = equations_.breaking(s);
      if (s.direction == 0.0) return masses == 1 && Drive::states == 0;  // nothing moves
    }
    if constexpr (masses == 2) {
      if ((dry_ || play_) && stepper_.divide(s, value_of(h)).count() > 1) return false;
    }
    typename State::Moving next = s;
    stepper_.linear_update(s, h, next.x, next.position);
    if ((dry_ || play_) && !events_.moves_on(s, next)) return false;
    s.x = next.x;
    s.position = next.position;
    return true;
  }

  void advance_with_events(State& s, S left) {
    const double whole = value_of(left);
    int events = 0;
    for (; events < most_events && value_of(left) > 1e-12 * whole; ++events) {
      if (dry_ && s.direction == 0.0) s.direction = equations_.breaking(s);
      if (events > 0) stepper_.use(Use::rests);
      const S rest = left;
      const Division parts = stepper_.divide(s, value_of(rest));
      for (int k = 0; k < parts.count(); ++k) {
        const S h = parts.length(k, rest);
        const State next = stepper_.step(s, h);
        if (!events_.continues(s, next)) {
          left -= events_.pass(s, h, next);
          break;
        }
        s = next;
        left -= h;
      }
    }
    if (events == most_events && value_of(left) > 0.0) {  // it rattles: the rest of the interval is one step
      s = stepper_.step(s, left);
      settle(s);
    }
    stepper_.use(Use::intervals);
  }

  static constexpr int most_events = 40;  // between two samples

  Equations<S, Drive, masses> equations_;
  Stepper<S, Drive, masses> stepper_{equations_};
  Events<S, Drive, masses> events_{equations_, stepper_};
  const bool dry_ = equations_.dry();
  const bool play_ = equations_.plays();
  const bool exact_ = !equations_.varies() && !equations_.finishes();  // constant terms: one step whatever its length
};

}  // namespace rwn
