#include "rwn/speed_measurement.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace rwn {

SpeedMeasurement speed_measurement_of(std::string_view name) {
  if (name == "instantaneous") return SpeedMeasurement::instantaneous;
  if (name == "central_difference") return SpeedMeasurement::central_difference;
  if (name == "backward_difference") return SpeedMeasurement::backward_difference;
  if (name == "forward_difference") return SpeedMeasurement::forward_difference;
  throw std::invalid_argument("no speed measurement is called '" + std::string(name) + "'");
}

void difference(SpeedMeasurement measurement, std::span<const double> time, std::span<const double> position,
                std::span<double> speed, std::size_t width) {
  const std::size_t n = time.size();
  const Reach reach = rwn::reach(measurement);
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t first = k - std::min(reach.before, k);
    std::size_t last = std::min(k + reach.after, n - 1);
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
