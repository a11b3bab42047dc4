// What the effects that are switched on add to the equations of rwn/simulate/equations.hpp.
#pragma once

#include <algorithm>

#include "rwn/simulate/active_effects.hpp"
#include "rwn/simulate/drive_state.hpp"

namespace rwn {

template <class S, class Drive, int masses>
class EffectTerms {
 public:
  using Moving = MovingState<S, Drive, masses>;
  using State = DriveState<S, Drive, masses>;
  using Electrics = typename Drive::template Electrics<S>;
  static constexpr std::size_t w = State::w;

  EffectTerms(const Motor<S>& motor, const Electrics& electrics, const ActiveEffect<S>* effects, int count,
              double angle_per_position)
      : motor_(motor),
        electrics_(electrics),
        effects_(effects),
        count_(count),
        angle_per_position_(angle_per_position) {}

  /// Input and time of what is integrated next.
  void begin(const S& input, double time) {
    input_ = input;
    time_ = time;
  }

  /// Recorded minus simulated position, where angle-dependent effects follow the recorded one.
  void follow(const S& offset) { offset_ = offset; }

  const S& input() const { return input_; }

  /// Adds to `t`; `start` is the position at the start of the step, `memory` that of all effects then.
  void add(Terms<S>& t, const Moving& s, const S* memory, const S& start) const {
    Motion<S> x = motion_of(s, start);
    for (int k = 0; k < count_; ++k) {
      if (effects_[k].own != nullptr) effects_[k].own->apply(effects_[k].p, motor_, x, t);
      if (effects_[k].call.apply == nullptr) continue;
      x.memory = memory + effects_[k].memory;
      effects_[k].call.apply(effects_[k].p, motor_, x, t);
    }
  }

  /// Slope of the voltage drops that users' effects add [ohm].
  double own_drop_slope(const State& s) const {
    double slope = 0.0;
    for (int k = 0; k < count_; ++k) {
      const auto& e = effects_[k];
      if (e.own != nullptr) slope += e.own->drop_slope(e.p, motor_, motion_of(s, s.position));
    }
    return slope;
  }

  /// The fastest rate of change that an effect brings over the next h [1/s].
  double rate(const State& s, double acceleration, double h) const {
    double fastest = 0.0;
    Motion<S> x = motion_of(s, s.position);
    for (int k = 0; k < count_; ++k) {
      if (effects_[k].call.rate != nullptr) {
        x.memory = s.memory.data() + effects_[k].memory;
        fastest = std::max(fastest, effects_[k].call.rate(effects_[k].p, motor_, x, acceleration, h));
      } else if (effects_[k].own != nullptr && effects_[k].call.varies) {
        fastest = std::max(fastest, effects_[k].own->rate(effects_[k].p, motor_, x, acceleration, h));
      }
    }
    return fastest;
  }

  /// Lets the memories of effects follow a step of length h.
  void finish(const State& before, State& after, const S& h) const {
    const Motion<S> x0 = motion_of(before, before.position);
    const Motion<S> x1 = motion_of(after, before.position);
    for (int k = 0; k < count_; ++k) {
      if (effects_[k].call.finish != nullptr) {
        effects_[k].call.finish(effects_[k].p, motor_, h, x0, x1, after.memory.data() + effects_[k].memory);
      }
    }
  }

 private:
  S drive_torque(const Moving& s) const {
    if constexpr (Drive::forced) return input_;
    if constexpr (!Drive::forced) return electrics_.linear_torque(s.x);
  }

  Motion<S> motion_of(const Moving& s, const S& start) const {
    return {.time = time_,
            .direction = s.direction,
            .input = input_,
            .current = electrics_.current(s.x),
            .speed = s.x[w],
            .position = s.position,
            .angle = angle_per_position_ * (s.position + offset_),
            .angle_per_position = angle_per_position_,
            .drive_torque = drive_torque(s),
            .travel = s.position - start,
            .winding = &electrics_.winding(),
            .memory = nullptr};
  }

  const Motor<S>& motor_;
  const Electrics& electrics_;
  const ActiveEffect<S>* effects_;
  int count_;
  double angle_per_position_;
  S input_{};
  double time_ = 0.0;
  S offset_{};
};

}  // namespace rwn
