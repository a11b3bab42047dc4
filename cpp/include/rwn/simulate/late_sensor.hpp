// Sensors that show at each sample what was a while before.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "rwn/model/motor.hpp"
#include "rwn/simulate/simulation_slice.hpp"

namespace rwn {

/// One of them, of a current or of a speed and its position.
template <class S>
class LateSensor {
 public:
  /// Makes room for the samples that are kept at once: all that a delay lasts over.
  void begin(const SimulationSlice& slice, const S& delay, bool of_current) {
    delay_ = delay;
    of_current_ = of_current;
    int most = 1, shown = 0;
    for (int k = 0; k < slice.samples; ++k) {
      while (shown < k && slice.time[k] - slice.time[shown] > value_of(delay_) * (1.0 + next_to)) ++shown;
      most = std::max(most, k - shown + 2);
    }
    kept_.resize(2 * static_cast<std::size_t>(most));
  }

  /// Whether there is a sample of which it knows nothing yet, and the instant that it will show there.
  bool waits(const SimulationSlice& slice) const { return next_ < slice.samples; }
  S instant(const SimulationSlice& slice) const { return slice.time[next_] - delay_; }
  bool is_due(const SimulationSlice& slice, double now) const {
    return waits(slice) && slice.time[next_] - value_of(delay_) <= now + next_to * value_of(delay_);
  }

  void keep(const Reading<S>& y) {
    const std::size_t at = place(next_++);
    kept_[at] = of_current_ ? y.current : y.speed;
    if (!of_current_) kept_[at + 1] = y.position;
  }
  void show(int k, Reading<S>& y) const {
    const std::size_t at = place(k);
    (of_current_ ? y.current : y.speed) = kept_[at];
    if (!of_current_) y.position = kept_[at + 1];
  }

 private:
  /// Share of a delay within which an instant is now: a step to there would be lost in the rounding of the times.
  static constexpr double next_to = 1e-9;
  std::size_t place(int k) const { return 2 * static_cast<std::size_t>(k) % kept_.size(); }

  S delay_{0.0};
  bool of_current_ = false;
  int next_ = 0;
  std::vector<S> kept_;  // a ring
};

/// Those of a run.
template <class S>
class LateSensors {
 public:
  void add(const SimulationSlice& slice, const S& delay, bool of_current) {
    if (count_ < most) sensors_[count_++].begin(slice, delay, of_current);
  }

  /// Whether one of them shows an instant before `next`, which it then is.
  bool show_sooner(const SimulationSlice& slice, S& next) const {
    bool sooner = false;
    for (std::size_t j = 0; j < count_; ++j) {
      if (!sensors_[j].waits(slice)) continue;
      const S instant = sensors_[j].instant(slice);
      if (value_of(instant) >= value_of(next)) continue;
      next = instant;
      sooner = true;
    }
    return sooner;
  }
  /// Keeps what they show of the instants until now: of now what `read` returns.
  template <class Read>
  void keep_until(const SimulationSlice& slice, double now, const Read& read) {
    for (std::size_t j = 0; j < count_; ++j) {
      while (sensors_[j].is_due(slice, now)) sensors_[j].keep(read());
    }
  }
  void show(int k, Reading<S>& y) const {
    for (std::size_t j = 0; j < count_; ++j) sensors_[j].show(k, y);
  }

 private:
  static constexpr std::size_t most = 2;  // of the current, and of speed and position
  std::array<LateSensor<S>, most> sensors_;
  std::size_t count_ = 0;
};

}  // namespace rwn
