#pragma once

#include "rwn/model/effect.hpp"

namespace rwn {

struct LoadDisturbance {
  static constexpr EffectInfo info{"load-disturbance", Site::load, "T = -T_d for t_start <= t < t_end",
                                   "a load that acts for a while, at the same time in every recording", "standard"};
  static constexpr std::array parameters{Parameter{.name = "torque",
                                                   .symbol = "T_d",
                                                   .unit = "N m",
                                                   .meaning = "brakes positive rotation",
                                                   .lower = -2.0,
                                                   .upper = 2.0,
                                                   .start = 0.1,
                                                   .scale = scale::torque,
                                                   .strength = true},
                                         Parameter{.name = "t_start",
                                                   .symbol = "t_start",
                                                   .unit = "s",
                                                   .meaning = "begin, after the start of the recording",
                                                   .lower = 0.0,
                                                   .upper = 1.0,
                                                   .start = 0.3,
                                                   .scale = scale::duration},
                                         Parameter{.name = "t_end",
                                                   .symbol = "t_end",
                                                   .unit = "s",
                                                   .meaning = "end",
                                                   .lower = 0.0,
                                                   .upper = 1.0,
                                                   .start = 0.6,
                                                   .scale = scale::duration}};
  static constexpr EffectTraits traits{.hooks = Hook::apply | Hook::breaks, .varies = false, .one_sided = true};

  template <class S>
  static void apply(const S* p, const Motor<S>&, const Motion<S>& x, Terms<S>& t) {
    if (x.time >= value_of(p[1]) && x.time < value_of(p[2])) t.torque -= p[0];
  }
  template <class S>
  static std::array<S, 2> breaks(const S* p) {
    return {p[1], p[2]};
  }
};

}  // namespace rwn
