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
  SpeedMeasurement speed_measurement{};
  /// Reflection coefficients (partial autocorrelations, each below 1 in size) of the noise of current, speed and
  /// position, as an autoregression of that order: errors count as what is new in each beyond what those before
  /// predict (Cochrane, Orcutt 1949; Durbin 1960), and the weights belong to that part. Empty: white.
  std::array<std::vector<double>, 3> reflection{};
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
