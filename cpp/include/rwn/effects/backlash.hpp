#pragma once

#include "rwn/effect.hpp"

namespace rwn {

struct Backlash {
  static constexpr EffectInfo info{
      "backlash", Site::load,
      "T_shaft = k dead(theta - theta_L, gap) + contact damping; J_L dw_L/dt = T_shaft - 0.3 B w_L",
      "play between motor and load", "Nordin, Gutman 2002; contact: Hunt, Crossley 1975"};
  static constexpr std::array parameters{Parameter{.name = "gap",
                                                   .unit = "rad",
                                                   .meaning = "total play",
                                                   .lower = 1e-5,
                                                   .upper = 3.0,
                                                   .start = 0.05,
                                                   .scan = {0.01, 0.05, 0.25},
                                                   .strength = true},
                                         Parameter{.name = "load_inertia",
                                                   .unit = "kg m^2",
                                                   .meaning = "part of the inertia that is behind it",
                                                   .lower = 0.02,
                                                   .upper = 0.95,
                                                   .start = 0.4,
                                                   .scale = Scale::inertia,
                                                   .scan = {0.2, 0.5}}};
  static constexpr int hiddens = 2;               // twist theta - theta_L [rad], load speed [rad/s]
  static constexpr double contact_rate = 1200.0;  // natural frequency of the closed gap [rad/s]: hard against the drive
  static constexpr double contact_damping = 0.02;    // loss per approach speed of the closed gap [s/rad]
  static constexpr double load_viscous_share = 0.3;  // of B, on the load side

  template <class S>
  static void apply(const S* p, const Motor<S>& m, const Motion<S>& x, Terms<S>& t) {
    const S& load = p[1];
    const S reduced = load * (m[inertia] - load) / m[inertia];
    const S& twist = x.hidden[0];
    const S& load_speed = x.hidden[1];
    const S half = 0.5 * p[0];
    S torque(0.0);
    if (value_of(twist) > value_of(half) || value_of(twist) < -value_of(half)) {
      const S bend = value_of(twist) > 0.0 ? twist - half : twist + half;
      const S approach = value_of(twist) > 0.0 ? x.speed - load_speed : load_speed - x.speed;
      const S grip = 1.0 + contact_damping * approach;
      if (value_of(grip) > 0.0) torque = reduced * (contact_rate * contact_rate) * bend * grip;  // it never pulls
    }
    const S share = load_viscous_share * m[viscous_friction];
    t.inertia -= load;
    t.torque += share * x.speed - torque;
    t.hidden_rate[0] = x.speed - load_speed;
    t.hidden_rate[1] = (torque - share * load_speed) / load;
  }
  template <class S>
  static double rate(const S*, const Motor<S>&, const Motion<S>&, double) {
    return contact_rate;
  }
};

}  // namespace rwn
