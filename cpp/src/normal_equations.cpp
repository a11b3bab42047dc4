#include "rwn/normal_equations.hpp"

#include <algorithm>
#include <cmath>

namespace rwn {
namespace {

void accumulate(NormalEquations& sum, std::span<const double> measured, std::span<const double> simulated,
                std::span<const double> slopes, double weight, std::size_t p) {
  for (std::size_t k = 0; k < measured.size(); ++k) {
    const double error = weight * (measured[k] - simulated[k]);
    if (std::isnan(error)) continue;
    sum.chi2 += error * error;
    ++sum.count;
    const double* row = slopes.data() + k * p;
    for (std::size_t i = 0; i < p; ++i) {
      const double slope = weight * row[i];
      sum.gradient[i] += slope * error;
      double* out = sum.curvature.data() + i * p;
      for (std::size_t j = 0; j <= i; ++j) out[j] += slope * weight * row[j];
    }
  }
}

}  // namespace

void central_difference(std::span<const double> time, std::span<const double> position, std::span<double> speed,
                        std::size_t width) {
  const std::size_t n = time.size();
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t before = k == 0 ? 0 : k - 1;
    const std::size_t after = std::min(k + 1, n - 1);
    const double inverse = 1.0 / (time[after] - time[before]);
    for (std::size_t j = 0; j < width; ++j) {
      speed[k * width + j] = (position[after * width + j] - position[before * width + j]) * inverse;
    }
  }
}

NormalEquations normal_equations(const SimulationTask& task, const Measurements& measured) {
  const std::size_t n = task.time.size();
  const std::size_t p = task.by.size();
  const bool difference = measured.speed_measurement == SpeedMeasurement::central_difference;
  const bool wants_position = !measured.position.empty() || (difference && !measured.speed.empty());
  const auto room = [&](bool wanted, std::size_t width) { return std::vector<double>(wanted ? n * width : 0); };
  std::vector<double> current = room(!measured.current.empty(), 1), d_current = room(!measured.current.empty(), p);
  std::vector<double> speed = room(!measured.speed.empty(), 1), d_speed = room(!measured.speed.empty(), p);
  std::vector<double> position = room(wants_position, 1), d_position = room(wants_position, p);

  NormalEquations sum;
  sum.gradient.assign(p, 0.0);
  sum.curvature.assign(p * p, 0.0);
  sum.status = simulate(task, {current, speed, position, d_current, d_speed, d_position});
  if (difference && !measured.speed.empty()) {
    central_difference(task.time, position, speed, 1);
    central_difference(task.time, d_position, d_speed, p);
  }
  accumulate(sum, measured.current, current, d_current, measured.current_weight, p);
  accumulate(sum, measured.speed, speed, d_speed, measured.speed_weight, p);
  accumulate(sum, measured.position, position, d_position, measured.position_weight, p);
  for (std::size_t i = 0; i < p; ++i) {
    for (std::size_t j = i + 1; j < p; ++j) sum.curvature[i * p + j] = sum.curvature[j * p + i];
  }
  return sum;
}

}  // namespace rwn
