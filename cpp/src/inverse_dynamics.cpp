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

/// The switched-on effects along a given motion, with the states that they carry from sample to sample.
class AlongMotion {
 public:
  AlongMotion(const Motor<Real>& motor, std::span<const int> active, const std::vector<Real>& values) : motor_(motor) {
    int memory = 0;
    for (int effect : active) {
      const auto& call = all_effect_functions<Real>[static_cast<std::size_t>(effect)];
      effects_.push_back({call, values.data() + first_parameter(effect), memory});
      memory += call.memories;
    }
  }

  /// What the effects add at motion `x`.
  Terms<Real> terms(Motion<Real> x) const {
    Terms<Real> t;
    x.hidden = hidden_.data();
    for (const auto& effect : effects_) {
      x.memory = memory_.data() + effect.memory;
      if (effect.call.apply != nullptr) effect.call.apply(effect.p, motor_, x, t);
    }
    return t;
  }

  /// Takes the states over an interval of length h from motion `x` to motion `next`.
  void follow(const Motion<Real>& x, Motion<Real> next, double h) {
    move_hidden(x, next, h);
    next.travel = next.position - x.position;
    for (const auto& effect : effects_) {
      if (effect.call.finish == nullptr) continue;
      effect.call.finish(effect.p, motor_, h, x, next, memory_.data() + effect.memory);
    }
  }

 private:
  static constexpr int most_steps = 64;

  /// Differential states by the midpoint rule, the motion taken as even between the samples.
  void move_hidden(const Motion<Real>& x, const Motion<Real>& next, double h) {
    double rate = 0.0;
    bool any = false;
    for (const auto& effect : effects_) {
      if (effect.call.hiddens == 0) continue;
      any = true;
      if (effect.call.rate != nullptr) rate = std::max(rate, effect.call.rate(effect.p, motor_, x, 0.0));
    }
    if (!any) return;
    const int steps = std::clamp(static_cast<int>(std::ceil(h * rate / 0.3)), 1, most_steps);
    const double part = h / steps;
    for (int k = 0; k < steps; ++k) {
      const auto before = hidden_;
      advance(before, terms(between(x, next, (k + 0.0) / steps)), 0.5 * part);
      advance(before, terms(between(x, next, (k + 0.5) / steps)), part);
    }
  }

  void advance(const std::array<Real, 2>& from, const Terms<Real>& t, double h) {
    for (std::size_t k = 0; k < hidden_.size(); ++k) hidden_[k] = from[k] + h * t.hidden_rate[k];
  }

  static Motion<Real> between(const Motion<Real>& a, const Motion<Real>& b, double share) {
    Motion<Real> x = a;
    x.speed += share * (b.speed - a.speed);
    x.position += share * (b.position - a.position);
    x.angle += share * (b.angle - a.angle);
    return x;
  }

  const Motor<Real>& motor_;
  std::vector<ActiveEffect<Real>> effects_;
  std::array<Real, max_memories> memory_{};
  std::array<Real, 2> hidden_{};
};

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
  AlongMotion effects(motor, active, values);
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
