// Locates an instant within a step at which something changes, and carries it in the scalar S so that the derivatives
// include its shift.
#pragma once

#include <algorithm>

#include "rwn/simulate/stepper.hpp"

namespace rwn {

/// Root of g on (0, h], where g(0) = at_zero >= 0 > g(h) = at_h: inverse quadratic interpolation where it can be
/// trusted, else bisection (Chandrupatla 1997). Where g starts at 0 and is positive nowhere that is looked at, 0.
template <class G>
double root(double h, double at_zero, double at_h, const G& g) {
  constexpr double tolerance = 1e-13;  // of h
  double a = h, b = 0.0, fa = at_h, fb = at_zero;  // the latest point, and the one across the root
  for (double x = 0.5 * h; fb <= 0.0; x *= 0.5) {
    if (x < 0.01 * h) return 0.0;
    const double fx = g(x);
    (fx > 0.0 ? b : a) = x;
    (fx > 0.0 ? fb : fa) = fx;
  }
  if (fa == 0.0) return a;
  double step = fa / (fa - fb);  // from a towards b, as part of the way
  for (int k = 0; k < 60; ++k) {
    const double x = a + std::clamp(step, tolerance * h / std::abs(b - a), 1.0) * (b - a);
    const double fx = g(x);
    double c = a, fc = fa;
    if ((fx >= 0.0) != (fa >= 0.0)) {
      c = b, fc = fb;
      b = a, fb = fa;
    }
    a = x, fa = fx;
    if (fa == 0.0 || std::abs(b - a) <= 2.0 * tolerance * h) return std::abs(fa) <= std::abs(fb) ? a : b;
    const double place = (a - b) / (c - b), height = (fa - fb) / (fc - fb);
    const bool smooth = height * height < place && (1.0 - height) * (1.0 - height) < 1.0 - place;
    step = smooth ? fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb) : 0.5;
    step = std::min(step, 1.0 - tolerance * h / std::abs(b - a));
  }
  return a;
}

template <class S, class Drive, int masses>
class EventSearch {
 public:
  using State = DriveState<S, Drive, masses>;

  explicit EventSearch(Stepper<S, Drive, masses>& stepper) : stepper_(stepper) {}

  /// The instant within h, between `s` and `beyond`, at which g of the state goes through zero from above; `at_once`
  /// where it is there already, but for rounding.
  template <class G>
  double instant(const State& s, const S& h, const State& beyond, const G& g) {
    const Use before = stepper_.use(Use::search);
    const auto at = [&](double tau) { return g(stepper_.step(s, S(tau))); };
    const double found = root(value_of(h), std::max(g(s), 0.0), g(beyond), at);
    stepper_.use(before);
    return std::max(found, at_once(h));
  }

  /// The shortest length of a step, for none may be 0.
  static double at_once(const S& h) { return 1e-13 * value_of(h); }

  /// dg/dt where the state has got in the time `instant`, by a difference along its rates that is short against it.
  template <class G>
  double slope(const State& there, double instant, const G& g) {
    const double nudge = 1e-6 * instant;
    return (g(stepper_.moved(there, S(nudge))) - g(there)) / nudge;
  }

  /// The state at an instant, with the derivatives of both.
  State at(const State& s, const S& instant) {
    const Use before = stepper_.use(Use::rests);
    const State there = stepper_.step(s, instant);
    stepper_.use(before);
    return there;
  }

  /// The state after `duration` with the derivatives of both; `there`: its value alone.
  State at(const State& s, const State& there, const S& duration) {
    return stepper_.finishes() ? at(s, duration) : stepper_.moved(there, duration - value_of(duration));
  }

  /// The instant with its derivatives, by the implicit function theorem: g(tau, p) = 0 with g as of the state there.
  static S shifted(double instant, const S& g, double slope) {
    S tau(instant);
    if (std::abs(slope) > 1e-300) tau -= (g - value_of(g)) / slope;
    return tau;
  }

 private:
  Stepper<S, Drive, masses>& stepper_;
};

}  // namespace rwn
