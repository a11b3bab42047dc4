// Dry friction is set-valued: the instants at which sliding stops and sticking gives way are located within a step, and
// carried in the scalar S so that the derivatives include their shift.
#pragma once

#include "rwn/stepper.hpp"

namespace rwn {

/// Root of g on (0, h], where g(0) = at_low >= 0 > g(h) = at_high, by the Illinois method.
template <class G>
double illinois(double h, double at_low, double at_high, const G& g) {
  double low = 0.0, high = h;
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

template <class S, Kind kind>
class FrictionEvents {
 public:
  using State = DriveState<S, kind>;
  static constexpr std::size_t w = State::n - 1;

  FrictionEvents(Equations<S, kind>& equations, Stepper<S, kind>& stepper) : equations_(equations), stepper_(stepper) {}

  /// True where `next`, a step after `s`, still slides or sticks as `s` did.
  bool continues(const State& s, const State& next) {
    return s.direction != 0.0 ? s.direction * value_of(next.x[w]) >= 0.0 : equations_.breaking(next) == 0.0;
  }

  /// Puts `s` at the end of its sliding or sticking, which lies within h; returns the time that it took.
  S pass(State& s, const S& h, const State& beyond) {
    return s.direction != 0.0 ? stop(s, h, beyond) : break_away(s, h, beyond);
  }

 private:
  S stop(State& s, const S& h, const State& beyond) {
    if (value_of(s.x[w]) == 0.0) {  // could not start: the friction holds after all
      s.direction = 0.0;
      s = stepper_.step(s, h);
      s.x[w] = S(0.0);
      return h;
    }
    const auto ahead = [&](const State& x) { return s.direction * value_of(x.x[w]); };
    const double instant = root(s, h, beyond, ahead);
    const State there = stepper_.step(s, S(instant));
    const S duration = shifted(instant, there.x[w], equations_.acceleration(there));
    s = stepper_.step(s, duration);
    s.x[w] = S(0.0);
    s.direction = 0.0;
    s.direction = equations_.breaking(s);
    return duration;
  }

  S break_away(State& s, const S& h, const State& beyond) {
    const double direction = equations_.breaking(beyond);
    const auto excess = [&](const State& x) { return equations_.excess_torque(x, direction); };
    const double instant = root(s, h, beyond, [&](const State& x) { return -value_of(excess(x)); });
    const S there = excess(stepper_.step(s, S(instant)));
    const double nudge = 1e-6 * value_of(h);
    const double slope = (value_of(excess(stepper_.step(s, S(instant + nudge)))) - value_of(there)) / nudge;
    const S duration = shifted(instant, there, slope);
    s = stepper_.step(s, duration);
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

  /// The instant within h, between `s` and `beyond`, at which g of the state goes through zero.
  template <class G>
  double root(const State& s, const S& h, const State& beyond, const G& g) {
    stepper_.search(true);
    const auto at = [&](double tau) { return g(stepper_.step(s, S(tau))); };
    const double found = illinois(value_of(h), g(s), g(beyond), at);
    stepper_.search(false);
    return found;
  }

  Equations<S, kind>& equations_;
  Stepper<S, kind>& stepper_;
};

}  // namespace rwn
