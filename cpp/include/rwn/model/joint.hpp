// What couples the motor to a second mass: an elastic shaft, or one with play. The torque in it is
//
//   T = k bend + c (w - w_L),   bend = theta - theta_L beyond half the gap on the side of contact,
//
// in contact only and never pulling where there is play. Its equations are linear while contact lasts and while the gap
// is open, so the integrator solves them exactly (rwn/simulate/equations.hpp) and locates what changes (rwn/simulate/contact_events.hpp).
#pragma once

namespace rwn {

inline constexpr double load_viscous_share = 0.3;  // of B, on the load side

template <class S>
struct Joint {
  S stiffness{};     // k [N m/rad]
  S damping{};       // c [N m s/rad]
  S load_inertia{};  // part of J behind it [kg m^2]
  S half_gap{};      // [rad]
  bool play = false;
};

}  // namespace rwn
