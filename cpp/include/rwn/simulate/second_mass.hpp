// The mass behind a joint, in the equations of motion of rwn/simulate/equations.hpp.
#pragma once

#include <algorithm>
#include <cmath>

#include "rwn/model/joint.hpp"
#include "rwn/simulate/drive_state.hpp"

namespace rwn {

struct NoSecondMass {
  static constexpr bool play() { return false; }
  static constexpr bool drives() { return false; }
  static constexpr bool sound() { return true; }
  static const auto& inverse_driven(const auto& first) { return first; }
};

template <class S, class Drive>
class SecondMass {
 public:
  using Moving = MovingState<S, Drive, 2>;
  using Matrix = SmallMatrix<S, Moving::n>;
  static constexpr int n = Moving::n;
  static constexpr std::size_t w = Moving::w, twist = Moving::twist, speed_behind = Moving::speed_behind;

  SecondMass() = default;
  SecondMass(const Joint<S>& joint, const Motor<S>& motor)
      : joint_(joint), first_inertia_(motor[inertia] - joint.inertia_behind), drag_(joint.viscous_behind) {
    const S inverse = 1.0 / first_inertia_ + 1.0 / joint_.inertia_behind;
    rate_ = std::sqrt(std::abs(value_of(joint_.stiffness * inverse)));
    if (!(rate_ > 1.0)) rate_ = 1.0;
    inverse_behind_ = 1.0 / joint_.inertia_behind;
    scaled_stiffness_ = joint_.stiffness / rate_;
    preload_ = joint_.stiffness * joint_.half_gap;
  }

  bool play() const { return joint_.play; }
  bool drives() const { return joint_.drives; }  // it is the motor
  bool sound() const { return value_of(inverse_behind_) > 0.0; }

  /// Of the mass that the drive turns; `first`: of the first one.
  const S& inverse_driven(const S& first) const { return joint_.drives ? inverse_behind_ : first; }
  const S& first_inertia() const { return first_inertia_; }  // of the first mass: the load where `drives`
  S first_viscous(const Motor<S>& motor) const { return motor[viscous_friction] - drag_; }

  /// It starts with the first mass, in the middle of the gap.
  void begin(Moving& s) const {
    s.x[speed_behind] = s.x[w];
    s.contact = joint_.play ? 0.0 : 1.0;
  }

  /// T of a joint whose contact is that of `s`, even where it would pull.
  S torque(const Moving& s) const {
    if (s.contact == 0.0) return S(0.0);
    return spring(s) - s.contact * preload_;
  }

  /// How far into contact a gap is on `side` [rad]: T / k of the closed joint.
  S pressing(const Moving& s, double side) const { return side * (spring(s) / joint_.stiffness) - joint_.half_gap; }

  /// How far the gap is overlapped on `side` [rad].
  S overlap(const Moving& s, double side) const { return side / rate_ * s.x[twist] - joint_.half_gap; }

  /// Part of T that the linear equations leave out.
  S constant_torque(const Moving& s) const { return -s.contact * preload_; }
  const S& inverse_behind() const { return inverse_behind_; }

  /// Part of T in the linear equations.
  S spring(const Moving& s) const {
    return scaled_stiffness_ * s.x[twist] + joint_.damping * (s.x[w] - s.x[speed_behind]);
  }

  /// Contact as the twist has it, of a state that has just been set.
  void touch(Moving& s) const {
    if (!joint_.play) return;
    s.contact = value_of(s.x[twist]) > 0.0 ? 1.0 : -1.0;
    if (value_of(overlap(s, s.contact)) <= 0.0 || value_of(pressing(s, s.contact)) <= 0.0) s.contact = 0.0;
  }

  /// Twists the joint as this mass asks for where it turns with the first at an acceleration, driven by a torque.
  void carry(Moving& s, double acceleration, const S& driving) const {
    s.x[speed_behind] = s.x[w];
    const S passed = acceleration / inverse_behind_ + drag_ * s.x[w] - driving;
    if (joint_.play) s.contact = value_of(passed) > 0.0 ? 1.0 : -1.0;
    s.x[twist] = (passed + s.contact * preload_) / scaled_stiffness_;
  }

  /// Takes twist and speed behind over h while the first mass's speed goes evenly from `from` to `to` (midpoint rule).
  void follow(Moving& s, const S& from, const S& to, double h) const {
    const double asked =
        std::ceil(h * (rate_ + value_of(joint_.damping * (1.0 / first_inertia_ + inverse_behind_))) / 0.3);
    const int steps = asked > 1.0 ? static_cast<int>(std::min(asked, most_steps_along)) : 1;
    const Moving end = s;
    for (int k = 0; k < steps; ++k) {
      const Moving begin = s;
      const auto advance = [&](double share, double length) {
        s.x[w] = from + share * (to - from);
        touch(s);
        const S twisting = rate_ * (s.x[w] - s.x[speed_behind]), rate = acceleration_behind(s);
        s.x[twist] = begin.x[twist] + length * twisting;
        s.x[speed_behind] = begin.x[speed_behind] + length * rate;
      };
      advance((k + 0.0) / steps, 0.5 * h / steps);
      advance((k + 0.5) / steps, h / steps);
    }
    s.x[w] = end.x[w];
  }

  S acceleration_behind(const Moving& s) const { return (torque(s) - drag_ * s.x[speed_behind]) * inverse_behind_; }

  /// Puts the second mass into A, where the first one's own part is.
  void couple(Matrix& a, const Regime& regime) const {
    at(a, twist, w) = S(rate_);
    at(a, twist, speed_behind) = S(-rate_);
    at(a, speed_behind, speed_behind) = -(drag_ * inverse_behind_);
    if (!regime.closed()) return;
    at(a, speed_behind, w) = joint_.damping * inverse_behind_;
    at(a, speed_behind, twist) = scaled_stiffness_ * inverse_behind_;
    at(a, speed_behind, speed_behind) -= at(a, speed_behind, w);
    if (regime.stick()) return;
    const S inverse = 1.0 / first_inertia_;
    at(a, w, speed_behind) = joint_.damping * inverse;
    at(a, w, twist) = -(scaled_stiffness_ * inverse);
    at(a, w, w) -= at(a, w, speed_behind);
  }

  /// Steps over h that are short enough to notice where contact ends or motion reverses; one where the joint hardly
  /// swings. `rates`: of `s`; `held`: torque by which friction holds a stuck shaft beyond what pulls at it.
  template <class Rates>
  int step_count(const Moving& s, const Rates& rates, bool dry, double held, double h) const {
    if (s.contact == 0.0 || (!joint_.play && !dry)) return 1;
    const bool stick = dry && s.direction == 0.0;
    const double inverse = value_of(inverse_behind_) + (stick ? 0.0 : 1.0 / value_of(first_inertia_));
    const double omega = std::sqrt(value_of(joint_.stiffness) * inverse);
    const double damping = value_of(joint_.damping) * inverse;
    const double turning = s.contact * (value_of(s.x[w]) - value_of(s.x[speed_behind]));
    const double bending = s.contact * (rates[w] - rates[speed_behind]);
    // of the swing about where the joint would rest: its acceleration can be no larger than this
    const double swing = std::hypot(bending + damping * turning, omega * turning) * std::hypot(1.0, damping / omega);
    if (!std::isfinite(swing)) return 1;
    const bool lasts = !joint_.play || bending + s.contact * value_of(torque(s)) * inverse > swing;
    const double change = (std::abs(rates[w]) + swing) * h + swing / omega;  // of the motor's speed, at most
    const bool goes_on = !dry || (stick ? 2.0 * swing < held * inverse : s.direction * value_of(s.x[w]) > change);
    if (lasts && goes_on) return 1;
    return static_cast<int>(std::min(std::ceil(omega * h / angle_of_a_step), most_steps));
  }

 private:
  static constexpr double angle_of_a_step = 1.0;
  static constexpr double most_steps = 16.0;
  static constexpr double most_steps_along = 64.0;  // of a given motion, between two samples

  static S& at(Matrix& a, std::size_t row, std::size_t column) { return a[row * n + column]; }

  Joint<S> joint_{};
  S first_inertia_{}, drag_{}, inverse_behind_{}, scaled_stiffness_{}, preload_{};
  double rate_ = 1.0;  // unit of the twist in x, so that all of x is of one size
};

}  // namespace rwn
