// THE motor equations, and the places (sites) where effects attach to them:
//
//   (L lambda(i)) di/dt = v - (R rho) i - (Ke kappa) w - drop(i)
//   (J + J2(theta)) dw/dt = (Kt kappa) i - B w - m g l sin(theta) + torque - friction - w^2 J2'(theta) / 2
//   dtheta/dt = w
//
// v passes the actuator effects, what is recorded passes the sensor effects. Other drives (drives/) have
// something else before the shaft: an axis a known torque (or force) u in place of Kt i. Dry friction is a level that
// opposes motion and holds at standstill (a set-valued law, integrated exactly by `integrator.hpp`).
#pragma once

#include <array>
#include <string_view>

#include "rwn/model/parameter.hpp"
#include "rwn/model/winding.hpp"
#include "rwn/numerics/dual.hpp"

namespace rwn {

/// Index of each parameter of the motor itself, in the order of `motor_parameters`.
enum MotorParameter : int {
  resistance,
  inductance,
  torque_constant,
  back_emf_constant,
  inertia,
  viscous_friction,
  coulomb_friction,
  pendulum_torque,
  initial_current,
  initial_speed,
  initial_position,
  motor_parameter_count
};

inline constexpr std::array<Parameter, motor_parameter_count> motor_parameters{{
    {"resistance", "R", "ohm", "terminal resistance R", 1e-3, 1e3, 1.0},
    {"inductance", "L", "H", "winding inductance L", 1e-3, 1e3, 1.0},
    {"torque_constant", "Kt", "N m/A", "torque per ampere Kt", 1e-3, 1e3, 1.0},
    {"back_emf_constant", "Ke", "V s/rad", "back-EMF per speed Ke", 1e-3, 1e3, 1.0},
    {"inertia", "J", "kg m^2", "moment of inertia J (mass of a linear axis)", 1e-3, 1e3, 1.0},
    {"viscous_friction", "B", "N m s/rad", "viscous friction B", 0.0, 1e3, 1.0},
    {"coulomb_friction", "Tc", "N m", "dry friction level Tc of the nominal model", 0.0, 1e3, 1.0},
    {"pendulum_torque", "m g l", "N m", "known pendulum load m g l: brakes with m g l sin(theta)", 0.0, 1e3, 1.0},
    {"initial_current", "i(0)", "A", "current at the first sample", -1e3, 1e3, 0.0},
    {"initial_speed", "w(0)", "rad/s", "speed at the first sample", -1e3, 1e3, 0.0},
    {"initial_position", "theta(0)", "rad", "position at the first sample", -1e6, 1e6, 0.0},
}};

/// Parameters of the motor itself, in scalar type S.
template <class S>
using Motor = std::array<S, motor_parameter_count>;

/// Where the motor is at one instant, as an effect sees it.
template <class S>
struct Motion {
  double time = 0.0;       // since the start of the recording [s]
  double direction = 1.0;  // of sliding, or of impending motion at standstill
  S input{};               // voltage at the winding [V], or driving torque of an axis [N m]
  S current{};
  S speed{};
  S position{};
  S angle{};                        // position as an angle: 2 pi times metres on a linear axis
  double angle_per_position = 1.0;  // rad/rad, or 2 pi rad/m
  S drive_torque{};                 // Kt i, or the driving torque of an axis [N m]
  S travel{};                       // position minus position at the start of the step
  const Winding<S>* winding = &no_winding<S>;  // what drives the current, where the drive has such
  const S* memory = nullptr;        // this effect's own memory, as of the start of the step
};

/// What the active effects add to the motor equations at one instant.
template <class S>
struct Terms {
  S torque{0.0};         // drives positive rotation [N m]
  S friction{0.0};       // level of dry friction in `direction` [N m]
  S drop{0.0};           // voltage drop in the winding circuit [V]
  S resistance{1.0};     // ratio rho
  S inductance{1.0};     // ratio lambda
  S flux{1.0};           // ratio kappa of Kt and Ke
  S inertia{0.0};        // J2 [kg m^2]
  S inertia_slope{0.0};  // dJ2/dtheta
  double drop_slope = 0.0;  // d drop / d i: keeps the integrator stable [ohm]
};

/// What the sensors say of one sample.
template <class S>
struct Reading {
  S input{};  // before the first sample, where a memory begins
  S current{};
  S speed{};
  S position{};
};

}  // namespace rwn
