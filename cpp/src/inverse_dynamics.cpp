#include "rwn/inverse_dynamics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "rwn/active_effects.hpp"
#include "rwn/memory.hpp"

namespace rwn {
namespace {

struct Plain {};
using Real = Dual<0, Plain>;

/// The switched-on effects along a given motion, with the states that they carry from sample to sample.
class AlongMotion {
 public:
  AlongMotion(const Motor<Real>& motor, std::span<const int> active, const std::vector<Real>& values,
              std::span<const OwnEffect> own)
      : motor_(motor) {
    for (const OwnEffect& effect : own) own_.emplace_back(effect.plain(), stack_.data(), &failed_);
    int memory = 0;
    for (int effect : active) {
      if (effect >= effect_count) {
        const int slot = effect - effect_count;
        const auto& formula = own_.at(static_cast<std::size_t>(slot));
        const int first = first_own_parameter() + slot * max_own_parameters;
        effects_.push_back({functions_of(formula), values.data() + first, memory, &formula});
        continue;
      }
      const auto& call = all_effect_functions<Real>[static_cast<std::size_t>(effect)];
      effects_.push_back({call, values.data() + first_parameter(effect), memory});
      if (call.joint != nullptr) joint_ = call.joint(effects_.back().p, motor_);
      memory += call.memories;
    }
  }
  AlongMotion(const AlongMotion&) = delete;  // its parts refer to each other
  AlongMotion& operator=(const AlongMotion&) = delete;

  /// What the effects add at motion `x`.
  Terms<Real> terms(Motion<Real> x) {
    Terms<Real> t;
    failed_ = false;
    for (const auto& effect : effects_) {
      x.memory = memory_.data() + effect.memory;
      if (effect.own != nullptr) effect.own->apply(effect.p, motor_, x, t);
      if (effect.call.apply != nullptr) effect.call.apply(effect.p, motor_, x, t);
    }
    if (joint_) {
      t.inertia -= joint_->load_inertia;
      t.torque += load_drag() * x.speed - joint_->torque(twist_, x.speed - load_speed_);
    }
    if (failed_) t.torque = std::numeric_limits<double>::quiet_NaN();
    return t;
  }

  /// Takes the states over an interval of length h from motion `x` to motion `next`.
  void follow(const Motion<Real>& x, Motion<Real> next, double h) {
    if (joint_) move_load(x, next, h);
    next.travel = next.position - x.position;
    for (const auto& effect : effects_) {
      if (effect.call.finish == nullptr) continue;
      effect.call.finish(effect.p, motor_, h, x, next, memory_.data() + effect.memory);
    }
  }

 private:
  static constexpr double most_steps = 64.0;

  Real load_drag() const { return load_viscous_share * motor_[viscous_friction]; }

  /// Twist and speed of a second mass by the midpoint rule, the speed taken as even between the samples.
  void move_load(const Motion<Real>& x, const Motion<Real>& next, double h) {
    const double reduced = joint_->load_inertia.v * (1.0 - joint_->load_inertia.v / motor_[inertia].v);
    const double rate = std::sqrt(joint_->stiffness.v / reduced) + joint_->damping.v / reduced;
    const double asked = std::ceil(h * rate / 0.3);
    const int steps = asked > 1.0 ? static_cast<int>(std::min(asked, most_steps)) : 1;
    const double part = h / steps;
    for (int k = 0; k < steps; ++k) {
      const Real twist = twist_, load_speed = load_speed_;
      const auto advance = [&](double share, double length) {
        const Real turning = x.speed + share * (next.speed - x.speed) - load_speed_;
        const Real torque = joint_->torque(twist_, turning) - load_drag() * load_speed_;
        twist_ = twist + length * turning;
        load_speed_ = load_speed + length * torque / joint_->load_inertia;
      };
      advance((k + 0.0) / steps, 0.5 * part);
      advance((k + 0.5) / steps, part);
    }
  }

  const Motor<Real>& motor_;
  std::array<Real, formula_depth> stack_{};
  bool failed_ = false;
  std::vector<ActiveOwnEffect<Real>> own_;
  std::vector<ActiveEffect<Real>> effects_;
  std::array<Real, max_memories> memory_{};
  std::optional<Joint<Real>> joint_;
  Real twist_, load_speed_;  // of a second mass [rad, rad/s]
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
  const auto motion_at = [&](std::size_t k) {
    Motion<Real> x;
    x.time = time[k] - time[0];
    x.direction = speed[k] > 0.0 ? 1.0 : speed[k] < 0.0 ? -1.0 : 0.0;
    x.speed = speed[k];
    x.position = position[k];
    x.angle = angle_per_position * position[k];
    x.angle_per_position = angle_per_position;
    return x;
  };
  AlongMotion effects(motor, active, values, own);
  for (std::size_t k = 0; k < n; ++k) {
    const Motion<Real> x = motion_at(k);
    const Terms<Real> t = effects.terms(x);
    torque[k] = (motor[inertia].v + t.inertia.v) * acceleration[k] + motor[viscous_friction].v * speed[k] +
                x.direction * (base_friction + t.friction.v) + 0.5 * t.inertia_slope.v * speed[k] * speed[k] +
                motor[pendulum_torque].v * std::sin(position[k]) - t.torque.v;
    if (k + 1 < n) effects.follow(x, motion_at(k + 1), time[k + 1] - time[k]);
  }
}

}  // namespace rwn
