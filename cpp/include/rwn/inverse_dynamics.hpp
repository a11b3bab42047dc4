// The driving torque that the model needs for a given motion.
#pragma once

#include <span>

#include "rwn/simulate.hpp"

namespace rwn {

/// torque = (J + J2) dw/dt + B w + friction + J2' w^2 / 2 + m g l sin(theta) - other torques, along the given motion,
/// (n) each, SI. States of their own (bristles, twist) start at rest and follow the motion. Throws std::invalid_argument on lengths that
/// do not fit.
void inverse_dynamics(std::span<const double> parameters, std::span<const int> active, double angle_per_position,
                      std::span<const double> time, std::span<const double> position, std::span<const double> speed,
                      std::span<const double> acceleration, std::span<double> torque);

}  // namespace rwn
