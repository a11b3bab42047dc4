// A parameter is described once, where it belongs; every other layer reads this description.
#pragma once

#include <array>
#include <string_view>

namespace rwn {

/// The quantity that a parameter is measured against, so that bounds and starting values fit a 1 W and a 500 W motor.
/// torque, speed, voltage, current: the largest of the recordings; inertia, damping, stiffness, drag: made from these
/// and the motor's inertia; time_step, duration: of the recordings; loss: the mean loss of the winding R i^2, in K/W per
/// kelvin of rise, heat: the loss over a recording, in J/K per kelvin.
enum class Scale {
  none, torque, speed, voltage, current, inertia, damping, stiffness, drag, time_step, duration, loss, heat
};

constexpr std::string_view to_string(Scale scale) {
  constexpr std::string_view names[] = {"none",    "torque",    "speed", "voltage",   "current", "inertia",
                                        "damping", "stiffness", "drag",  "time_step", "duration", "loss", "heat"};
  return names[static_cast<int>(scale)];
}

struct Parameter {
  std::string_view name;
  std::string_view unit;
  std::string_view meaning;
  double lower = 0.0;  // in units of `scale`, as are upper, start and scan
  double upper = 0.0;
  double start = 0.0;  // first guess
  Scale scale = Scale::none;
  std::array<double, 24> scan{};  // other first guesses worth trying; zeros at the end do not count
  bool inverse = false;          // the effect vanishes as this grows, not as it goes to zero
  bool strength = false;         // zero means that the effect is absent
  bool fixed = false;            // a constant of nature or convention, never fitted
  bool cyclic = false;           // an angle
  bool order = false;            // a spatial frequency, found from a spectrum over the angle
  bool window = false;           // an instant, found from a change in the residual over time
  bool resonance = false;        // stiffness, damping and inertia, in this order, found from a resonance of the residual
  bool many_minima = false;      // of the error along it: first guesses are looked at before anything is fitted
  bool lattice = false;          // a quantum, read off the recorded values
  bool idealised = false;        // a limit is an idealisation (abrupt, rigid) that is as good a law
  int replaces = -1;             // the nominal motor parameter whose role this one takes over
};

}  // namespace rwn
