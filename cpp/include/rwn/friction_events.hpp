// Dry friction is set-valued: the instants at which sliding stops and sticking gives way are located within a step, and
// carried in the scalar S so that the derivatives include their shift.
#pragma once

#include "rwn/stepper.hpp"

namespace rwn {

/// Root of g on (0, h], g(0) >= 0 > g(h), by the Illinois method.
template <class G>
double illinois(double h, const G& g) {
  double low = 0.0, high = h, at_low = g(0.0), at_high = g(h);
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
    return s.direction != 0.0 ? stop(s, h) : break_away(s, h, equations_.breaking(beyond));
  }

 private:
  S stop(State& s, const S& h) {
    if (value_of(s.x[w]) == 0.0) {  // could not start: the friction holds after all
      s.direction = 0.0;
      s = stepper_.step(s, h);
      s.x[w] = S(0.0);
      return h;
    }
    const double instant =
        root(value_of(h), [&](double tau) { return s.direction * value_of(stepper_.step(s, S(tau)).x[w]); });
    const State there = stepper_.step(s, S(instant));
    const S duration = shifted(instant, there.x[w], equations_.acceleration(there));
    s = stepper_.step(s, duration);
    s.x[w] = S(0.0);
    s.direction = 0.0;
    s.direction = equations_.breaking(s);
    return duration;
  }

  S break_away(State& s, const S& h, double direction) {
    const auto excess = [&](double tau) { return equations_.excess_torque(stepper_.step(s, S(tau)), direction); };
    const auto margin = [&](double tau) { return -value_of(excess(tau)); };
    const double instant = root(value_of(h), margin);
    const double nudge = 1e-6 * value_of(h);
    const double slope = (margin(instant) - margin(instant + nudge)) / nudge;
    const S duration = shifted(instant, excess(instant), slope);
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

  template <class G>
  double root(double h, const G& g) {
    stepper_.search(true);
    const double found = illinois(h, g);
    stepper_.search(false);
    return found;
  }

  Equations<S, kind>& equations_;
  Stepper<S, kind>& stepper_;
};

}  // namespace rwn
