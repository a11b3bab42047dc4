// Dry friction is set-valued: the instants at which sliding stops and sticking gives way are located within a step.
#pragma once

#include "rwn/simulate/event_search.hpp"

namespace rwn {

template <class S, class Drive, int masses>
class FrictionEvents {
 public:
  using State = DriveState<S, Drive, masses>;
  static constexpr std::size_t w = State::w;

  FrictionEvents(Equations<S, Drive, masses>& equations, EventSearch<S, Drive, masses>& search)
      : equations_(equations), search_(search) {}

  /// True where `next`, a step after `s`, still slides or sticks as `s` did.
  bool continues(const State& s, const State& next) {
    if (s.direction != 0.0 || !equations_.dry()) return slides_on(s, next);
    return equations_.breaking(next) == 0.0;
  }

  /// True where `next`, a step after an `s` that slides or that nothing brakes, still moves as `s` did.
  bool slides_on(const State& s, const typename State::Moving& next) const {
    return !(s.direction * value_of(next.x[w]) < 0.0);  // what is not finite goes on, to be found by the sample loop
  }

  /// True where a shaft that was held is pulled off in a direction.
  bool gives_way(const State& held, double direction) { return equations_.breaking(held) == direction; }

  /// When the sliding or sticking of `s` ends, before `beyond`, which is h later.
  double instant(const State& s, const S& h, const State& beyond) {
    if (s.direction != 0.0) return search_.instant(s, h, beyond, [&](const State& x) { return ahead(s, x); });
    const double direction = equations_.breaking(beyond);
    return search_.instant(s, h, beyond, [&](const State& x) { return -value_of(excess(x, direction)); });
  }

  /// Puts `s` at that instant; returns the time that it took.
  S pass(State& s, double instant, const State& beyond) {
    return s.direction != 0.0 ? stop(s, instant) : break_away(s, instant, equations_.breaking(beyond));
  }

 private:
  static double ahead(const State& s, const State& x) { return s.direction * value_of(x.x[w]); }
  S excess(const State& x, double direction) { return equations_.excess_torque(x, direction); }

  S stop(State& s, double instant) {
    const State there = search_.at(s, instant);
    const S duration = search_.shifted(instant, there.x[w], equations_.acceleration(there));
    s = search_.at(s, there, duration);
    s.x[w] = S(0.0);
    s.direction = 0.0;
    s.direction = equations_.breaking(s);
    return duration;
  }

  S break_away(State& s, double instant, double direction) {
    const State there = search_.at(s, instant);
    const auto pulling = [&](const State& x) { return value_of(excess(x, direction)); };
    const S duration = search_.shifted(instant, excess(there, direction), search_.slope(there, instant, pulling));
    s = search_.at(s, there, duration);
    s.x[w] = S(0.0);
    s.direction = direction;
    return duration;
  }

  Equations<S, Drive, masses>& equations_;
  EventSearch<S, Drive, masses>& search_;
};

}  // namespace rwn
