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
        angle_per_position_(angle_per_position) {
    motion_.angle_per_position = angle_per_position;
    motion_.winding = &electrics.winding();
    for (int k = 0; k < count; ++k) {
      const auto& call = effects[k].call;
      const bool own = effects[k].own != nullptr;
      own_ = own_ || own;
      turns_ = turns_ || own || call.turns;
      loaded_ = loaded_ || own || call.loaded;
      travels_ = travels_ || call.memories > 0;
      torque_alone_ = torque_alone_ && !call.electrical && !call.scales;
      scales_ = scales_ || call.scales;
    }
  }

  /// Input and time of what is integrated next.
  void begin(const S& input, double time) {
    motion_.input = input;
    motion_.time = time;
  }

  /// Recorded minus simulated position, where angle-dependent effects follow the recorded one.
  void follow(const S& offset) { offset_ = offset; }

  const S& input() const { return motion_.input; }

  /// Whether one changes the flux or the inertia.
  bool scales() const { return scales_; }

  /// Makes `t` those without effects. What no effect adds to is as it was made.
  RWN_INLINE void renew(Terms<S>& t, const S& friction) const {
    if (!torque_alone_) t = {};
    t.torque = S(0.0);
    t.friction = friction;
  }

  /// Adds to `t`; `start` is the position at the start of the step, `memory` that of all effects then.
  RWN_INLINE void add(Terms<S>& t, const Moving& s, const S* memory, const S& start) {
    move(s, start);
    for (int k = 0; k < count_; ++k) {
      if (effects_[k].call.apply == nullptr) continue;
      motion_.memory = memory + effects_[k].memory;
      effects_[k].call.apply(effects_[k].p, motor_, motion_, t);
    }
    if (own_) add_own(t);
  }

  /// Slope of the voltage drops that users' effects add [ohm].
  double own_drop_slope(const State& s) {
    double slope = 0.0;
    if (!own_) return slope;
    move(s, s.position);
    for (int k = 0; k < count_; ++k) {
      const auto& e = effects_[k];
      if (e.own != nullptr) slope += e.own->drop_slope(e.p, motor_, motion_);
    }
    return slope;
  }

  /// The fastest rate of change that an effect brings over the next h [1/s].
  double rate(const State& s, double acceleration, double h) {
    double fastest = 0.0;
    move(s, s.position);
    for (int k = 0; k < count_; ++k) {
      if (effects_[k].call.rate != nullptr) {
        motion_.memory = s.memory.data() + effects_[k].memory;
        fastest = std::max(fastest, effects_[k].call.rate(effects_[k].p, motor_, motion_, acceleration, h));
      } else if (effects_[k].own != nullptr && effects_[k].call.varies) {
        fastest = std::max(fastest, effects_[k].own->rate(effects_[k].p, motor_, motion_, acceleration, h));
      }
    }
    return fastest;
  }

  /// Lets the memories of effects follow a step of length h.
  void finish(const State& before, State& after, const S& h) {
    move(before, before.position);
    const Motion<S> x0 = motion_;
    move(after, before.position);
    for (int k = 0; k < count_; ++k) {
      if (effects_[k].call.finish != nullptr) {
        effects_[k].call.finish(effects_[k].p, motor_, h, x0, motion_, after.memory.data() + effects_[k].memory);
      }
    }
  }

 private:
  S drive_torque(const Moving& s) const {
    if constexpr (Drive::forced) return motion_.input;
    if constexpr (!Drive::forced) return electrics_.linear_torque(s.x);
  }

  /// Puts what the effects see where `s` is; what none of them looks at stays as it was.
  RWN_INLINE void move(const Moving& s, const S& start) {
    motion_.direction = s.direction;
    motion_.current = electrics_.current(s.x);
    motion_.speed = s.x[w];
    motion_.position = s.position;
    if (turns_) motion_.angle = angle_per_position_ * (s.position + offset_);
    if (loaded_) motion_.drive_torque = drive_torque(s);
    if (travels_) motion_.travel = s.position - start;
  }

  [[gnu::noinline]] void add_own(Terms<S>& t) const {
    for (int k = 0; k < count_; ++k) {
      if (effects_[k].own != nullptr) effects_[k].own->apply(effects_[k].p, motor_, motion_, t);
    }
  }

  const Motor<S>& motor_;
  const Electrics& electrics_;
  const ActiveEffect<S>* effects_;
  int count_;
  double angle_per_position_;
  S offset_{};
  Motion<S> motion_{};  // of what is asked next; kept, since most of it stays from stage to stage
  bool own_ = false, turns_ = false, loaded_ = false, travels_ = false;  // what the effects look at
  bool torque_alone_ = true, scales_ = false;                            // what they add to
};

}  // namespace rwn
