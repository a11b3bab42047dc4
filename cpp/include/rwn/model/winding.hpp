// The equations of a winding, whatever drive it is part of:
//
//   L di/dt = v - R i - Ke w,    torque = Kt i
//
// The drive says what its values are (`Electrics::winding` in drives/), and with these the integrator, the effects and,
// through the binding, Python's drives ask what a winding does. What effects change of it is in motor.hpp.
#pragma once

#include "rwn/numerics/dual.hpp"

namespace rwn {

template <class S>
struct Winding {
  S resistance{};         // R [ohm]
  S inductance{};         // L [H]
  S torque_constant{};    // Kt [N m/A]
  S back_emf_constant{};  // Ke [V s/rad]

  /// Torque [N m] of a current [A].
  S torque(const S& current) const { return torque_constant * current; }

  /// Voltage [V] that a speed [rad/s] induces.
  S back_emf(const S& speed) const { return back_emf_constant * speed; }

  /// Voltage [V] that a current [A] takes which does not change.
  S resting_voltage(const S& current) const { return resistance * current; }

  /// Voltage [V] that is left at a speed [rad/s] to drive a current.
  S driving_voltage(const S& speed, const S& input) const { return input - back_emf_constant * speed; }

  /// Current [A] that is at rest with a speed [rad/s].
  S resting_current(const S& speed, const S& input) const { return driving_voltage(speed, input) / resistance; }

  /// Power [W] lost to heat at a mean square of the current [A^2].
  S heat(const S& square) const { return resistance * square; }

  /// Rate [1/s] at which the back-EMF brakes an inertia [kg m^2] where the current is at rest with the speed.
  double braking_rate(double inertia) const {
    return value_of(torque_constant) * value_of(back_emf_constant) / (value_of(resistance) * inertia);
  }
};

/// What effects see of a drive without a winding.
template <class S>
inline constexpr Winding<S> no_winding{};

}  // namespace rwn
