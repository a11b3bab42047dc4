// The state of a drive of one mass, or of two with a joint between them.
#pragma once

#include "rwn/model/motor.hpp"
#include "rwn/numerics/exponential.hpp"
#include "rwn/model/memory.hpp"

namespace rwn {

/// What moves within a step.
template <class S, class Drive, int masses>
struct MovingState {
  static constexpr std::size_t w = Drive::states;                    // place of the first mass's speed in x
  static constexpr std::size_t twist = w + 1, speed_behind = w + 2;  // places of what a second mass adds
  static constexpr int n = static_cast<int>(w) + (masses == 2 ? 3 : 1);
  SmallVector<S, n>
      x{};  // states of the drive's electrical part, speed; twist [1/rate of the joint], speed behind it
  S position{};
  double direction = 0.0;  // of sliding; 0 sticks
  double contact = 0.0;    // side on which the joint transmits: 0 while its gap is open, 1 where there is none
};

/// The state of a motion with what effects remember from step to step.
template <class S, class Drive, int masses>
struct DriveState : MovingState<S, Drive, masses> {
  using Moving = MovingState<S, Drive, masses>;
  Memory<S> memory{};
};

/// Inputs that the equations do not know: a torque, and the voltage of a winding.
template <class S>
struct UnknownInputs {
  S torque{}, voltage{};
};

/// What the linear part of the equations depends on, in one number, since every step asks for it.
class Regime {
 public:
  Regime() = default;
  Regime(int level, bool stick, bool closed) : key_(4 * level + 2 * stick + closed) {}
  int level() const { return key_ / 4; }           // the winding is linearised at R 2^level
  bool stick() const { return (key_ & 2) != 0; }   // a stuck shaft has no equation of motion
  bool closed() const { return (key_ & 1) != 0; }  // the joint transmits
  bool operator==(const Regime&) const = default;

 private:
  int key_ = -1;
};

}  // namespace rwn
