#pragma once

#include "rwn/effect.hpp"

namespace rwn {

struct Backlash {
  static constexpr EffectInfo info{
      "backlash", Site::load,
      "T_shaft = k dead(theta - theta_L, gap) + c (w - w_L) in contact, never pulls; J_L dw_L/dt = T_shaft - 0.3 B w_L",
      "play between motor and load", "Nordin, Gutman 2002; contact: Brogliato 1999, ch. 2"};
  static constexpr std::array parameters{Parameter{.name = "gap",
                                                   .unit = "rad",
                                                   .meaning = "total play",
                                                   .lower = 2e-4,
                                                   .upper = 3.0,
                                                   .start = 0.05,
                                                   .scan = {0.01, 0.03, 0.1, 0.2, 0.3, 0.45, 0.65, 1.0},
                                                   .strength = true},
                                         Parameter{.name = "load_inertia",
                                                   .unit = "kg m^2",
                                                   .meaning = "part of the inertia that is behind it",
                                                   .lower = 0.02,
                                                   .upper = 0.95,
                                                   .start = 0.4,
                                                   .scale = Scale::inertia,
                                                   .scan = {0.2, 0.4, 0.6}},
                                         Parameter{.name = "contact_rate",
                                                   .unit = "rad/s",
                                                   .meaning = "natural frequency of the closed gap",
                                                   .lower = 600.0,
                                                   .upper = 5000.0,
                                                   .start = 1500.0,
                                                   .idealised = true},
                                         Parameter{.name = "contact_damping_ratio",
                                                   .unit = "1",
                                                   .meaning = "damping ratio of the closed gap: how little it rebounds",
                                                   .lower = 0.01,
                                                   .upper = 2.0,
                                                   .start = 0.4,
                                                   .idealised = true}};
  static constexpr int hiddens = 2;                  // twist theta - theta_L [rad], load speed [rad/s]
  static constexpr double load_viscous_share = 0.3;  // of B, on the load side
  static constexpr double touch = 0.0005;            // part of half the gap over which the contact takes hold

  template <class S>
  static void apply(const S* p, const Motor<S>& m, const Motion<S>& x, Terms<S>& t) {
    const S& load = p[1];
    const S& twist = x.hidden[0];
    const S& load_speed = x.hidden[1];
    const S half = 0.5 * p[0];
    S torque(0.0);
    if (value_of(twist) > value_of(half) || value_of(twist) < -value_of(half)) {
      const S bend = value_of(twist) > 0.0 ? twist - half : twist + half;
      // the damping grows over the first touch, so that the force, and its derivatives, are continuous
      const S grip = bend / (bend + (value_of(bend) > 0.0 ? touch : -touch) * half);
      const S reduced = load * (m[inertia] - load) / m[inertia];
      torque = reduced * p[2] * (p[2] * bend + 2.0 * p[3] * grip * (x.speed - load_speed));
      if (value_of(torque) * value_of(bend) < 0.0) torque = S(0.0);  // it never pulls
    }
    const S share = load_viscous_share * m[viscous_friction];
    t.inertia -= load;
    t.torque += share * x.speed - torque;
    t.hidden_rate[0] = x.speed - load_speed;
    t.hidden_rate[1] = (torque - share * load_speed) / load;
  }
  template <class S>
  static double rate(const S* p, const Motor<S>&, const Motion<S>&, double, double) {
    return 2.0 * value_of(p[2]) * (1.1 + value_of(p[3]));  // always: steps that follow the contact roughen the error
  }
};

}  // namespace rwn
