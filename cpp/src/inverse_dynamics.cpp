#include "rwn/inverse_dynamics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "rwn/active_effects.hpp"

namespace rwn {
namespace {

struct Plain {};
using Real = Dual<0, Plain>;

/// The active effects at one instant after the other.
class ActiveTerms {
 public:
  ActiveTerms(const Motor<Real>& motor, std::span<const int> active, const std::vector<Real>& values,
              std::span<const OwnEffect> own)
      : motor_(motor), active_(active), values_(values) {
    for (const OwnEffect& effect : own) {
      const OwnProgram program{effect.term, effect.program.data(), static_cast<int>(effect.program.size())};
      own_.emplace_back(program, stack_.data(), &failed_);
    }
  }
  ActiveTerms(const ActiveTerms&) = delete;  // its parts refer to each other
  ActiveTerms& operator=(const ActiveTerms&) = delete;

  Terms<Real> at(Motion<Real> x) {
    static const std::array<Real, max_memories> at_rest{};
    Terms<Real> t;
    x.memory = at_rest.data();
    x.hidden = at_rest.data();
    failed_ = false;
    for (int effect : active_) {
      if (effect >= effect_count) {
        const auto slot = static_cast<std::size_t>(effect - effect_count);
        const auto first = static_cast<std::size_t>(first_own_parameter()) + slot * max_own_parameters;
        own_.at(slot).apply(values_.data() + first, motor_, x, t);
        continue;
      }
      const auto& call = all_effect_functions<Real>[static_cast<std::size_t>(effect)];
      if (call.apply != nullptr) call.apply(values_.data() + first_parameter(effect), motor_, x, t);
    }
    if (failed_) t.torque = std::numeric_limits<double>::quiet_NaN();
    return t;
  }

 private:
  const Motor<Real>& motor_;
  std::span<const int> active_;
  const std::vector<Real>& values_;
  std::array<Real, formula_depth> stack_{};
  bool failed_ = false;
  std::vector<ActiveOwnEffect<Real>> own_;
};

bool replaces_friction(std::span<const int> active) {
  return std::any_of(active.begin(), active.end(),
                     [](int e) {
                       return e < effect_count && all_effect_functions<Real>[static_cast<std::size_t>(e)].replaces;
                     });
}

}  // namespace

void inverse_dynamics(std::span<const double> parameters, std::span<const int> active, double angle_per_position,
                      std::span<const double> time, std::span<const double> position, std::span<const double> speed,
                      std::span<const double> acceleration, std::span<double> torque,
                      std::span<const OwnEffect> own) {
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
  ActiveTerms terms(motor, active, values, own);
  for (std::size_t k = 0; k < n; ++k) {
    Motion<Real> x;
    x.time = time[k] - time[0];
    x.direction = speed[k] > 0.0 ? 1.0 : speed[k] < 0.0 ? -1.0 : 0.0;
    x.speed = speed[k];
    x.position = position[k];
    x.angle = angle_per_position * position[k];
    x.angle_per_position = angle_per_position;
    const Terms<Real> t = terms.at(x);
    torque[k] = (motor[inertia].v + t.inertia.v) * acceleration[k] + motor[viscous_friction].v * speed[k] +
                x.direction * (base_friction + t.friction.v) + 0.5 * t.inertia_slope.v * speed[k] * speed[k] +
                motor[pendulum_torque].v * std::sin(position[k]) - t.torque.v;
  }
}

}  // namespace rwn
