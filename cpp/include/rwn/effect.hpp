// What an effect is. Each lives in effects/<effect>.hpp as a struct with static members:
//
//   info                              name, site, equation, meaning, source
//   parameters                        std::array<Parameter, n>
// and, where it needs them,
//   apply(p, motor, motion, terms)    its share of the motor equations
//   turns                             true: depends on the angle
//   varies                            false: terms change only with direction and at `breaks` (default true)
//   rate(p, motor, motion, acceleration, h)   fastest rate of change it brings over the next h [1/s]: sets the step
//   joint(p, motor)                   what couples the motor to the second mass that it brings
//   actuate(p, input)                 maps the commanded input to what acts
//   delay(p)                          input delay [s]
//   breaks(p)                         instants at which its terms jump [s]
//   memories, finish(p, motor, h, before, after, memory)     states that follow the motion, updated after each step
//   sense(p, reading, memory)         maps the true signals to what is recorded
// p points to the effect's parameters. All functions are templates on the scalar, which carries the derivatives.
#pragma once

#include <string_view>

#include "rwn/drive.hpp"
#include "rwn/dual.hpp"
#include "rwn/joint.hpp"

namespace rwn {

enum class Site { torque, voltage, flux, actuator, sensor, load };

constexpr std::string_view to_string(Site site) {
  constexpr std::string_view names[] = {"torque", "voltage", "flux", "actuator", "sensor", "load"};
  return names[static_cast<int>(site)];
}

/// The equation that an effect of this site belongs to, as diagnosis reports it.
constexpr std::string_view equation_of(Site site) {
  constexpr std::string_view names[] = {"mechanical", "electrical", "electrical", "actuator", "sensor", "mechanical"};
  return names[static_cast<int>(site)];
}

struct EffectInfo {
  std::string_view name;
  Site site;
  std::string_view equation;
  std::string_view meaning;
  std::string_view source;
};

}  // namespace rwn
