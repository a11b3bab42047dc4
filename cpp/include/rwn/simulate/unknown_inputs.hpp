// What the equations of a drive leave over along a given motion: the torque, and the voltage of the winding, that they
// do not know.
#pragma once

#include <span>

#include "rwn/simulate/simulate.hpp"

namespace rwn {

/// A motion with what drives it, (n) each, SI.
struct GivenMotion {
  std::span<const double> current;        // empty: at rest with the speed, as far as a winding has one
  std::span<const double> current_slope;  // dI/dt [A/s]; empty with `current`
  std::span<const double> speed, position, acceleration;
};

/// Of the equations of `task` (rwn/simulate/equations.hpp) along `motion`, at the instants of the task and under its
/// input: torque (n), positive where it drives positive rotation, and voltage (n), positive where it drives a current.
/// Memories of effects and a second mass start at rest and follow the motion; actuators, sensors and derivatives of the
/// task are ignored. `voltage` may be empty. Own effects whose formula has no value give NaN.
/// Throws std::invalid_argument for a transfer function, and for lengths that do not fit.
void unknown_inputs(const SimulationTask& task, const GivenMotion& motion, std::span<double> torque,
                    std::span<double> voltage);

}  // namespace rwn
