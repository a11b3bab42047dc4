// What couples the mass whose motion is measured to a second one: an elastic shaft, or one with play. The first is the
// motor, with a load behind it; or the load, with the motor behind it. The torque in the joint is
//
//   T = k bend + c (w - w_L),   bend = theta - theta_L beyond half the gap on the side of contact,
//
// in contact only and never pulling where there is play. Its equations are linear while contact lasts and while the gap
// is open, so the integrator solves them exactly (rwn/simulate/equations.hpp) and locates what changes
// (rwn/simulate/contact_events.hpp).
#pragma once

#include "rwn/model/motor.hpp"
#include "rwn/model/parameter.hpp"

namespace rwn {

/// Of B, behind a joint: part of the law of every effect that brings one, since no data sheet says it.
inline constexpr Parameter load_viscous_share{.name = "load_viscous_share",
                                              .symbol = "s",
                                              .unit = "1",
                                              .meaning = "part of the viscous friction that is behind it",
                                              .lower = 0.0,
                                              .upper = 1.0,
                                              .start = 0.4,
                                              .natural = true};

template <class S>
struct Joint {
  S stiffness{};       // k [N m/rad]
  S damping{};         // c [N m s/rad]
  S inertia_behind{};  // part of J behind it [kg m^2]
  S viscous_behind{};  // part of B behind it [N m s/rad]
  S half_gap{};        // [rad]
  bool play = false;
  bool drives = false;  // the drive turns the second mass, and the first one, which is measured and rubs, follows
};

/// A joint with the load before it, which is measured, and the motor behind it, which the drive turns.
template <class S>
Joint<S> with_load_first(Joint<S> joint, const Motor<S>& motor) {
  joint.inertia_behind = motor[inertia] - joint.inertia_behind;
  joint.viscous_behind = motor[viscous_friction] - joint.viscous_behind;
  joint.drives = true;
  return joint;
}

}  // namespace rwn
