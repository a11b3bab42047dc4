// How a recorded speed was obtained: by a tachometer, or as a difference of the position over one sample or two.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace rwn {

enum class SpeedMeasurement { instantaneous, central_difference, backward_difference, forward_difference };

/// Samples before and after the own one between whose positions the difference is taken.
struct Reach {
  std::size_t before = 0, after = 0;
};

constexpr Reach reach(SpeedMeasurement measurement) {
  switch (measurement) {
    case SpeedMeasurement::central_difference: return {1, 1};
    case SpeedMeasurement::backward_difference: return {1, 0};
    case SpeedMeasurement::forward_difference: return {0, 1};
    case SpeedMeasurement::instantaneous: break;
  }
  return {0, 0};
}

/// By its name as written above; throws std::invalid_argument where there is none of that name.
SpeedMeasurement speed_measurement_of(std::string_view name);

/// Replaces `speed` by the difference of `position` over `time`; rows are `width` wide.
///
/// At an end, where it would reach outside, the difference over the nearest sample. Not for an instantaneous speed;
/// needs two samples at least.
void difference(SpeedMeasurement measurement, std::span<const double> time, std::span<const double> position,
                std::span<double> speed, std::size_t width);

}  // namespace rwn
