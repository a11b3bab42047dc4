#pragma once

#include "rwn/effect.hpp"

namespace rwn {

struct ShaftCompliance {
  static constexpr EffectInfo info{"shaft-compliance", Site::load,
                                   "T_shaft = k (theta - theta_L) + c (w - w_L); J_L dw_L/dt = T_shaft - 0.3 B w_L",
                                   "a shaft or coupling that twists between motor and load (two masses)",
                                   "Schroeder, Elektrische Antriebe; thesis ref. 25"};
  static constexpr std::array parameters{Parameter{.name = "stiffness",
                                                   .unit = "N m/rad",
                                                   .meaning = "torque per twist",
                                                   .lower = 1e-5,
                                                   .upper = 1e4,
                                                   .start = 1.0,
                                                   .scale = Scale::stiffness,
                                                   .scan = {3e-4, 1e-3, 4e-3, 0.015, 0.05, 0.15, 0.5, 2.0},
                                                   .strength = true},
                                         Parameter{.name = "damping",
                                                   .unit = "N m s/rad",
                                                   .meaning = "torque per rate of twist",
                                                   .lower = 0.0,
                                                   .upper = 100.0,
                                                   .start = 0.1,
                                                   .scale = Scale::damping},
                                         Parameter{.name = "load_inertia",
                                                   .unit = "kg m^2",
                                                   .meaning = "part of the inertia that is behind it",
                                                   .lower = 0.02,
                                                   .upper = 0.95,
                                                   .start = 0.4,
                                                   .scale = Scale::inertia,
                                                   .scan = {0.25, 0.6}}};
  static constexpr int hiddens = 2;                  // twist theta - theta_L [rad], load speed [rad/s]
  static constexpr double load_viscous_share = 0.3;  // of B, on the load side

  template <class S>
  static void apply(const S* p, const Motor<S>& m, const Motion<S>& x, Terms<S>& t) {
    const S& load = p[2];
    const S torque = p[0] * x.hidden[0] + p[1] * (x.speed - x.hidden[1]);
    const S share = load_viscous_share * m[viscous_friction];
    t.inertia -= load;
    t.torque += share * x.speed - torque;
    t.hidden_rate[0] = x.speed - x.hidden[1];
    t.hidden_rate[1] = (torque - share * x.hidden[1]) / load;
  }
  template <class S>
  static double rate(const S* p, const Motor<S>& m, const Motion<S>&, double, double) {
    const double load = value_of(p[2]);
    const double reduced = load * (value_of(m[inertia]) - load) / value_of(m[inertia]);
    return std::sqrt(value_of(p[0]) / reduced) + value_of(p[1]) / reduced;
  }
};

}  // namespace rwn
