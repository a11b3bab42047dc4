#include "rwn/simulate/speed_measurement.hpp"

#include <algorithm>

namespace rwn {

void difference(SpeedMeasurement measurement, std::span<const double> time, std::span<const double> position,
                std::span<double> speed, std::size_t width) {
  const std::size_t n = time.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t first = k - std::min(measurement.before, k);
    std::size_t last = std::min(k + measurement.after, n - 1);
    if (first == last) {
      last = std::min(first + 1, n - 1);
      first = last - 1;
    }
    const double inverse = 1.0 / (time[last] - time[first]);
    for (std::size_t j = 0; j < width; ++j) {
      speed[k * width + j] = (position[last * width + j] - position[first * width + j]) * inverse;
    }
  }
}

}  // namespace rwn
