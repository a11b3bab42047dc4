// Parameters that effects which come back with the angle have in common.
#pragma once

#include <string_view>

#include "rwn/model/parameter.hpp"

namespace rwn::periodic {

inline constexpr Parameter peak_torque{.name = "amplitude",
                                       .symbol = "A",
                                       .unit = "N m",
                                       .meaning = "peak torque",
                                       .lower = 0.0,
                                       .upper = 1.0,
                                       .start = 0.03,
                                       .scale = scale::torque,
                                       .strength = true};
inline constexpr Parameter order{.name = "periods_per_rev",
                                 .symbol = "N",
                                 .unit = "1",
                                 .meaning = "periods per revolution (per metre on a linear axis)",
                                 .lower = 1.5,  // one is an unbalance
                                 .upper = 1000.0,
                                 .start = 12.0,
                                 .order = true};
/// That of a shaft that a gear makes slower.
inline constexpr Parameter slow_order = [] {
  Parameter p = order;
  p.meaning = "periods per revolution, 1 over the ratio of the gear";
  p.lower = 1e-3;
  p.upper = 0.9;
  p.start = 0.1;
  return p;
}();
/// A peak torque that is tried from weak to strong: a strong one traps the motor, and no small step leads there.
inline constexpr Parameter any_peak_torque = [] {
  Parameter p = peak_torque;
  p.scan = {0.03, 0.15, 0.6};
  return p;
}();
inline constexpr Parameter phase{.name = "phase",
                                 .symbol = "p",
                                 .unit = "rad",
                                 .meaning = "at position 0",
                                 .lower = -6.4,
                                 .upper = 6.4,
                                 .start = 0.0,
                                 .scan = {0.0, 1.5707963, 3.1415927, -1.5707963},
                                 .cyclic = true};

/// The same parameter of a further line of an effect; what it begins with is read off what the lines before leave.
constexpr Parameter further(Parameter p, int line, std::string_view name) {
  p.name = name;
  p.symbol = {};
  p.scan = {};
  p.line = line;
  return p;
}

}  // namespace rwn::periodic
