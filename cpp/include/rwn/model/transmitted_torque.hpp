#pragma once

#include <cmath>

#include "rwn/model/motor.hpp"

namespace rwn {

/// What a gear transmits: the drive's torque and that of the known pendulum behind it [N m].
template <class S>
S transmitted_torque(const Motor<S>& motor, const Motion<S>& x) {
  using std::sin;
  const S& pendulum = motor[pendulum_torque];
  return value_of(pendulum) == 0.0 ? x.drive_torque : x.drive_torque + pendulum * sin(x.position);
}

}  // namespace rwn
