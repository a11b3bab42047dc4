#include "rwn/simulate/speed_measurement.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string>

namespace rwn {

SpeedMeasurement speed_measurement_of(std::string_view name) {
  constexpr std::string_view names[] = {"instantaneous", "central_difference", "backward_difference",
                                        "forward_difference"};
  const auto* found = std::find(std::begin(names), std::end(names), name);
  if (found != std::end(names)) return static_cast<SpeedMeasurement>(found - std::begin(names));
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
