#pragma once

#include "rwn/model/effect.hpp"

namespace rwn {

struct PreslidingHysteresis {
  static constexpr EffectInfo info{"presliding-hysteresis", Site::torque,
                                   "dz/dt = w - s0 |w| z / T_c, T = -(s0 z + s1 dz/dt)",
                                   "friction that acts as a bristle spring before it slides (LuGre)",
                                   "Canudas de Wit, Olsson, Astrom, Lischinsky 1995"};
  static constexpr std::array parameters{Parameter{.name = "bristle_stiffness",
                                                   .symbol = "s0",
                                                   .unit = "N m/rad",
                                                   .meaning = "spring rate of the contact",
                                                   .lower = 1e-2,
                                                   .upper = 1e6,
                                                   .start = 30.0,
                                                   .scale = scale::torque,
                                                   .scan = {0.3, 3.0, 30.0, 300.0},
                                                   .strength = true},
                                         Parameter{.name = "bristle_damping",
                                                   .symbol = "s1",
                                                   .unit = "N m s/rad",
                                                   .meaning = "damping of the contact",
                                                   .lower = 0.0,
                                                   .upper = 1e3,
                                                   .start = 0.1,
                                                   .scale = scale::damping},
                                         Parameter{.name = "coulomb_torque",
                                                   .symbol = "T_c",
                                                   .unit = "N m",
                                                   .meaning = "sliding friction level",
                                                   .lower = 1e-4,
                                                   .upper = 1.0,
                                                   .start = 0.05,
                                                   .scale = scale::torque,
                                                   .replaces = coulomb_friction}};
  /// Memories: bristle deflection z [rad].
  static constexpr EffectTraits traits{.hooks = Hook::apply | Hook::rate | Hook::finish, .memories = 1};
  static constexpr double at_the_limit = 1e-4;  // share of the largest deflection

  /// Exact for motion in one direction: z relaxes to sign(w) T_c/s0 over the travelled angle.
  template <class S>
  static S deflection(const S* p, const S& z, const S& travel) {
    using std::exp;
    const S settled = (value_of(travel) < 0.0 ? -1.0 : 1.0) * p[2] / p[0];
    const S left = value_of(travel) < 0.0 ? p[0] * travel / p[2] : -(p[0] * travel / p[2]);
    return settled + (z - settled) * exp(left);
  }
  template <class S>
  static void apply(const S* p, const Motor<S>&, const Motion<S>& x, Terms<S>& t) {
    using std::abs;
    const S z = deflection(p, x.memory[0], x.travel);
    t.torque -= p[0] * z + p[1] * (x.speed - p[0] * abs(x.speed) * z / p[2]);
  }
  /// A bristle at its limit is no spring as long as the motion goes on in its direction.
  template <class S>
  static double rate(const S* p, const Motor<S>& m, const Motion<S>& x, double acceleration, double h) {
    const double speed = value_of(x.speed);
    const double bend = value_of(x.memory[0]) * value_of(p[0]) / value_of(p[2]) * (speed < 0.0 ? -1.0 : 1.0);
    if (std::abs(speed) > 2.0 * acceleration * h && std::abs(1.0 - bend) < at_the_limit) return 0.0;
    const double bent_in = std::sqrt(std::abs(acceleration) * value_of(p[0]) / value_of(p[2]));  // from a reversal on
    return std::sqrt(value_of(p[0]) / value_of(m[inertia])) + value_of(p[1]) / value_of(m[inertia]) + bent_in;
  }
  template <class S>
  static void finish(const S* p, const Motor<S>&, const S&, const Motion<S>&, const Motion<S>& after, S* memory) {
    memory[0] = deflection(p, memory[0], after.travel);
  }
};

}  // namespace rwn
