#pragma once

#include "rwn/model/effect.hpp"
#include "rwn/model/periodic.hpp"

namespace rwn {

/// Poles and slots that are not all alike bring orders of their own beside the one that both have in common, so that
/// there are several lines (Gasparin et al., IEEE Trans. Magnetics 45, 2009).
struct CoggingTorque {
  static constexpr EffectInfo info{"cogging-torque", Site::torque, "T = -A sin(N theta + p)",
                                   "torque of the magnets on the slots, or a position-periodic force",
                                   "Gieras, Permanent Magnet Motor Technology, ch. 6"};
  static constexpr std::array parameters{periodic::any_peak_torque,
                                         periodic::order,
                                         periodic::phase,
                                         periodic::further(periodic::peak_torque, 1, "amplitude_2"),
                                         periodic::further(periodic::order, 1, "periods_per_rev_2"),
                                         periodic::further(periodic::phase, 1, "phase_2"),
                                         periodic::further(periodic::peak_torque, 2, "amplitude_3"),
                                         periodic::further(periodic::order, 2, "periods_per_rev_3"),
                                         periodic::further(periodic::phase, 2, "phase_3"),
                                         periodic::further(periodic::peak_torque, 3, "amplitude_4"),
                                         periodic::further(periodic::order, 3, "periods_per_rev_4"),
                                         periodic::further(periodic::phase, 3, "phase_4")};
  static constexpr EffectTraits traits{.hooks = Hook::apply | Hook::rate,
                                       .turns = true,
                                       .one_sided = true,
                                       .guess = Guess::spectrum};

  template <class S>
  static void apply(const S* p, const Motor<S>&, const Motion<S>& x, Terms<S>& t) {
    using std::sin;
    t.torque -= p[0] * sin(p[1] * x.angle + p[2]);
    for (std::size_t k = of_a_line; k < parameters.size(); k += of_a_line) {
      if (is_used(p[k])) t.torque -= p[k] * sin(p[k + 1] * x.angle + p[k + 2]);
    }
  }
  template <class S>
  static double rate(const S* p, const Motor<S>&, const Motion<S>& x, double, double) {
    // 1.3 rad of a period a step: the error of its quadrature, (1.3)^4 / 2880, is 0.1 % of the ripple
    double highest = value_of(p[1]);
    for (std::size_t k = of_a_line; k < parameters.size(); k += of_a_line) {
      if (is_used(p[k])) highest = std::max(highest, value_of(p[k + 1]));
    }
    return 0.55 * highest * std::abs(value_of(x.speed)) * x.angle_per_position;
  }

 private:
  static constexpr std::size_t of_a_line = 3;  // amplitude, order and phase
};

}  // namespace rwn
