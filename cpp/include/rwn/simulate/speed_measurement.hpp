// How a recorded speed was obtained: by a tachometer, or as a difference of the position over some samples.
#pragma once

#include <cstddef>
#include <span>

namespace rwn {

/// Samples before and after the own one between whose positions a difference is taken; none: an instantaneous speed.
/// A difference over more samples than one is the moving average of as many differences over one.
struct SpeedMeasurement {
  std::size_t before = 0, after = 0;

  bool is_difference() const { return before + after > 0; }
  friend bool operator==(const SpeedMeasurement&, const SpeedMeasurement&) = default;
};

/// Replaces `speed` by the difference of `position` over `time`; rows are `width` wide.
///
/// At an end, where it would reach outside, the difference over the nearest sample. Not for an instantaneous speed;
/// needs two samples at least.
void difference(SpeedMeasurement measurement, std::span<const double> time, std::span<const double> position,
                std::span<double> speed, std::size_t width);

}  // namespace rwn
