// A gap between two masses closes where they touch and opens where the joint would begin to pull: both instants are
// located within a step.
#pragma once

#include "rwn/simulate/event_search.hpp"

namespace rwn {

template <class S, class Drive>
class ContactEvents {
 public:
  using State = DriveState<S, Drive, 2>;
  using Moving = typename State::Moving;

  ContactEvents(Equations<S, Drive, 2>& equations, EventSearch<S, Drive, 2>& search)
      : equations_(equations), search_(search) {}

  /// Fixes the contact of a state that has just been set.
  void settle(State& s) const {
    if (second().play()) s.contact = touching(s);
  }

  /// True where `next`, a step after `s`, has the contact of `s`.
  bool continues(const State& s, const Moving& next) const {
    if (!second().play()) return true;
    return s.contact == 0.0 ? touching(next) == 0.0 : !(value_of(second().pressing(next, s.contact)) < 0.0);
  }

  /// When the contact of `s` begins or ends, before `beyond`, which is h later.
  double instant(const State& s, const S& h, const State& beyond) {
    const double side = side_of(s, beyond);
    return search_.instant(s, h, beyond, [&](const State& x) { return sign(s) * value_of(depth(x, s, side)); });
  }

  /// Puts `s` at that instant, where it has come to `there`; returns the time that it took.
  S pass(State& s, double instant, const State& there, const State& beyond) {
    const double side = side_of(s, beyond);
    const auto deep = [&](const State& x) { return value_of(depth(x, s, side)); };
    const S duration = search_.shifted(instant, depth(there, s, side), search_.slope(there, instant, deep));
    s = search_.at(s, there, duration);
    s.contact = s.contact == 0.0 ? side : 0.0;
    return duration;
  }

 private:
  const SecondMass<S, Drive>& second() const { return equations_.second(); }

  /// The side on which an open gap would transmit, 0 on none.
  double touching(const Moving& s) const {
    for (const double side : {1.0, -1.0}) {
      if (value_of(touch(s, side)) > 0.0) return side;
    }
    return 0.0;
  }

  /// Positive where an open gap has closed: the parts overlap and would push.
  S touch(const Moving& s, double side) const {
    const S overlap = second().overlap(s, side), pressing = second().pressing(s, side);
    return value_of(overlap) < value_of(pressing) ? overlap : pressing;
  }

  /// What is positive in contact and negative outside, on the way from `s`.
  S depth(const State& x, const State& s, double side) const {
    return s.contact == 0.0 ? touch(x, side) : second().pressing(x, side);
  }
  double side_of(const State& s, const State& beyond) const { return s.contact == 0.0 ? touching(beyond) : s.contact; }
  static double sign(const State& s) { return s.contact == 0.0 ? -1.0 : 1.0; }

  Equations<S, Drive, 2>& equations_;
  EventSearch<S, Drive, 2>& search_;
};

}  // namespace rwn
