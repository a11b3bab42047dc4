// Normal equations of the free-run output error, J'J and J'r, without handing the Jacobian around.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "rwn/simulate/simulate.hpp"
#include "rwn/simulate/speed_measurement.hpp"

namespace rwn {

/// Recorded signals of one recording; empty spans are signals that were not recorded. NaN samples do not count.
struct Measurements {
  std::span<const double> current, speed, position;                        // (n)
  double current_weight = 1.0, speed_weight = 1.0, position_weight = 1.0;  // 1 / standard deviation
  SpeedMeasurement speed_measurement = SpeedMeasurement::instantaneous;
  /// Correlation of an error of current, speed and position with the one a sample before: errors count as what they are
  /// beyond that share of it (Cochrane, Orcutt 1949), and the weights belong to that part.
  std::array<double, 3> persistence{};
};

struct NormalEquations {
  SimulationStatus status = SimulationStatus::ok;
  double chi2 = 0.0;              // sum of squared weighted errors
  long count = 0;                 // of samples that counted
  std::vector<double> gradient;   // (p) J'r with r = weighted (measured - simulated)
  std::vector<double> curvature;  // (p, p) J'J
};

/// Simulates `task` (its derivatives by `task.by`) and accumulates the normal equations against `measured`.
NormalEquations normal_equations(const SimulationTask& task, const Measurements& measured);

}  // namespace rwn
