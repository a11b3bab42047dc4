#include "rwn/inverse_dynamics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "rwn/active_effects.hpp"

namespace rwn {
namespace {

struct Plain {};
using Real = Dual<0, Plain>;

Terms<Real> terms_of(const Motor<Real>& motor, std::span<const int> active, const std::vector<Real>& values,
                     Motion<Real> x) {
  static const std::array<Real, max_memories> at_rest{};
  Terms<Real> t;
  x.memory = at_rest.data();
  x.hidden = at_rest.data();
  for (int effect : active) {
    const auto& call = all_effect_functions<Real>[static_cast<std::size_t>(effect)];
    if (call.apply != nullptr) call.apply(values.data() + first_parameter(effect), motor, x, t);
  }
  return t;
}

bool replaces_friction(std::span<const int> active) {
  return std::any_of(active.begin(), active.end(),
                     [](int e) { return all_effect_functions<Real>[static_cast<std::size_t>(e)].replaces; });
}

}  // namespace

void inverse_dynamics(std::span<const double> parameters, std::span<const int> active, double angle_per_position,
                      std::span<const double> time, std::span<const double> position, std::span<const double> speed,
                      std::span<const double> acceleration, std::span<double> torque) {
  const std::size_t n = time.size();
  if (position.size() != n || speed.size() != n || acceleration.size() != n || torque.size() != n) {
    throw std::invalid_argument("inverse_dynamics: the signals differ in length");
  }
  if (parameters.size() != static_cast<std::size_t>(parameter_count())) {
    throw std::invalid_argument("inverse_dynamics: wrong number of parameters");
  }
  const std::vector<Real> values(parameters.begin(), parameters.end());
  Motor<Real> motor;
  std::copy_n(values.begin(), motor_parameter_count, motor.begin());
  const double base_friction = replaces_friction(active) ? 0.0 : motor[coulomb_friction].v;
  for (std::size_t k = 0; k < n; ++k) {
    Motion<Real> x;
    x.time = time[k] - time[0];
    x.direction = speed[k] > 0.0 ? 1.0 : speed[k] < 0.0 ? -1.0 : 0.0;
    x.speed = speed[k];
    x.position = position[k];
    x.angle = angle_per_position * position[k];
    x.angle_per_position = angle_per_position;
    const Terms<Real> t = terms_of(motor, active, values, x);
    torque[k] = (motor[inertia].v + t.inertia.v) * acceleration[k] + motor[viscous_friction].v * speed[k] +
                x.direction * (base_friction + t.friction.v) + 0.5 * t.inertia_slope.v * speed[k] * speed[k] +
                motor[pendulum_torque].v * std::sin(position[k]) - t.torque.v;
  }
}

}  // namespace rwn
