// A DC motor fed with a voltage: L lambda di/dt = v - R rho i - Ke kappa w - drop drives the shaft with Kt kappa i.
#pragma once

#include <cmath>
#include <cstddef>
#include <string_view>

#include "rwn/model/motor.hpp"

namespace rwn {

struct DcDrive {
  static constexpr std::string_view name = "dc";
  static constexpr int states = 1;              // before the speed in x: the current
  static constexpr bool forced = false;         // the input is no torque
  static constexpr bool coefficients = false;   // it has equations of motion
  static constexpr int widths[] = {4, 8, 12, 16};  // derivatives at once that a run is compiled for

  template <class S>
  class Electrics {
   public:
    explicit Electrics(const Motor<S>& motor)
        : winding_{.resistance = motor[resistance],
                   .inductance = motor[inductance],
                   .torque_constant = motor[torque_constant],
                   .back_emf_constant = motor[back_emf_constant]},
          initial_current_(motor[initial_current]),
          inverse_inductance_(1.0 / winding_.inductance) {}

    const Winding<S>& winding() const { return winding_; }

    void begin(auto& x) const { x[0] = initial_current_; }
    static S current(const auto& x) { return x[0]; }

    /// Torque on the shaft: its linear part, and as the flux has it.
    S linear_torque(const auto& x) const { return winding_.torque(x[0]); }
    S torque(const auto& x, const S& flux, const S&) const { return winding_.torque_constant * flux * x[0]; }

    /// Its part of A (n by n), the speed in row `w`; the resistance counts 2^level times.
    void couple(auto&& a, std::size_t n, std::size_t w, double resistances, const S& inverse_inertia,
                bool stick) const {
      a[0] = -(resistances * winding_.resistance * inverse_inductance_);
      a[w] = -(winding_.back_emf_constant * inverse_inductance_);
      if (!stick) a[w * n] = winding_.torque_constant * inverse_inertia;
    }

    /// dx/dt that the linear part leaves where no effect changes the winding.
    void drive(auto& f, const S& input) const { f[0] = input * inverse_inductance_; }

    /// The same in general.
    void remainder(auto& f, const auto& x, const S& speed, const Terms<S>& t, const S& input,
                   double resistances) const {
      const S back_emf = winding_.back_emf(speed);
      S left = voltage_left(x, back_emf, t, input);
      if (value_of(t.inductance) != 1.0) left /= t.inductance;
      f[0] = (left + resistances * winding_.resting_voltage(x[0]) + back_emf) * inverse_inductance_;
    }

    /// Voltage that the equation leaves over along a motion whose current changes by `slope` [A/s].
    S unknown_voltage(const auto& x, const S& speed, const Terms<S>& t, const S& input, double slope) const {
      return voltage_left(x, winding_.back_emf(speed), t, input) - winding_.inductance * t.inductance * slope;
    }

    /// Current in equilibrium with a speed: what a current that was not recorded is taken for.
    S resting_current(const S& speed, const S& input) const {
      return winding_.resting_current(speed, input);
    }

    /// A state with the electrical part at rest.
    auto settled(auto s, const S& speed, const S& input) const {
      s.x[0] = resting_current(speed, input);
      return s;
    }

    /// Rate of its transient [1/s].
    double rate(const Terms<S>& t) const {
      return value_of(winding_.resistance) / value_of(winding_.inductance * t.inductance);
    }

    /// Whether the current is about where it would settle, where `f` is what the linear part leaves of dx/dt. A step
    /// counts the current of its start for a sixth.
    bool is_settled(const auto& x, const S& speed, const auto& f, const Terms<S>& t) const {
      const double drop = value_of(winding_.resting_voltage(x[0]) + winding_.back_emf(speed));
      const double slope = value_of(f[0]) - drop * value_of(inverse_inductance_);
      return std::abs(slope) < settled_within * rate(t) * std::abs(value_of(x[0]));
    }

    /// How much faster it is than R/L; `slope`: of the voltage drops over the current [ohm].
    double speed_up(const Terms<S>& t, double slope) const {
      return (value_of(t.resistance) + slope / value_of(winding_.resistance)) / value_of(t.inductance);
    }

   private:
    static constexpr double settled_within = 0.001;  // of a current: a step's torque is then off by 2e-4 at most

    S voltage_left(const auto& x, const S& back_emf, const Terms<S>& t, const S& input) const {
      return input - t.resistance * winding_.resting_voltage(x[0]) - back_emf * t.flux - t.drop;
    }

    Winding<S> winding_;
    S initial_current_, inverse_inductance_;
  };
};

}  // namespace rwn
