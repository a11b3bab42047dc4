// What may end within a step: sliding, sticking, contact.
#pragma once

#include "rwn/simulate/contact_events.hpp"
#include "rwn/simulate/friction_events.hpp"

namespace rwn {

/// Contact of a single mass: none.
struct NoContact {
  template <class... T>
  explicit NoContact(T&...) {}
  template <class State>
  void settle(State&) const {}
  template <class State>
  bool continues(const State&, const typename State::Moving&) const {
    return true;
  }
};

template <class S, class Drive, int masses>
class Events {
 public:
  using State = DriveState<S, Drive, masses>;
  static constexpr std::size_t w = State::w;

  Events(Equations<S, Drive, masses>& equations, Stepper<S, Drive, masses>& stepper)
      : search_(stepper), friction_(equations, search_), contact_(equations, search_) {}

  /// Fixes the contact of a state that has just been set.
  void settle(State& s) const { contact_.settle(s); }

  /// True where `next`, a step after `s`, goes on as `s` did.
  bool continues(const State& s, const State& next) {
    return contact_.continues(s, next) && friction_.continues(s, next);
  }

  /// True where `next`, a step after an `s` that is not stuck, goes on as `s` did.
  bool moves_on(const State& s, const typename State::Moving& next) const {
    return contact_.continues(s, next) && friction_.slides_on(s, next);
  }

  /// Puts `s` at the first end, which lies within h, before `beyond`; returns the time that it took.
  S pass(State& s, S h, State beyond) {
    if constexpr (masses == 2) {
      if (!contact_.continues(s, beyond)) {
        const double instant = contact_.instant(s, h, beyond);
        const State there = search_.at(s, instant);
        if (friction_.continues(s, there)) return contact_.pass(s, instant, there, beyond);
        h = instant;
        beyond = there;
      }
    }
    const double instant = friction_.instant(s, h, beyond);
    if (instant > search_.at_once(h) || s.direction == 0.0) return friction_.pass(s, instant, beyond);
    const double back = -s.direction;
    s.direction = 0.0;  // could not start: the friction holds after all, or until it gives way to the other side
    const State held = search_.at(s, h);
    if (!contact_.continues(s, held) || friction_.gives_way(held, back)) return pass(s, h, held);
    s = held;
    s.x[w] = S(0.0);
    return h;
  }

 private:
  EventSearch<S, Drive, masses> search_;
  FrictionEvents<S, Drive, masses> friction_;
  [[no_unique_address]] std::conditional_t<masses == 2, ContactEvents<S, Drive>, NoContact> contact_;
};

}  // namespace rwn
