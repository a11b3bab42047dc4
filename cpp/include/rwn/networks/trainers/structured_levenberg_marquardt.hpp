#pragma once

#include <vector>

#include "rwn/networks/structured_network.hpp"

namespace rwn {

enum class FitStatus { converged, iteration_limit, stuck };
std::string_view to_string(FitStatus status);
std::string_view advice(FitStatus status);

/// Speed (n) of the plant A, [0; v4], [-v2; 0] for the input (n) and a given friction torque (n).
Vector simulate_plant(const StructuredNetwork& network, const StructuredSignals& signals, const VectorRef& torque);

/// Speed (n) of the network fed with the speed that it simulates itself (a free run; static network, c = 0), its
/// friction being torque(x) - slope * x.
Vector simulate_fed_back(const StructuredNetwork& network, double slope, const StructuredSignals& signals);

/// Where the network takes its speed from: `measured`, whose noise biases the parameters, or `simulated`, the model's
/// own (output error: no errors in variables, but only a static network and a start from which the free run is close).
enum class Feed { measured, simulated };
/// \throws std::invalid_argument for another name than `measured` or `simulated`.
Feed feed_by_name(std::string_view name);

/// What the batch fit is given. The network may be fed with another speed than the measured one (a smoothed or a
/// simulated one), so that noise on its input does not bias the parameters; a measured current, where there is one, is
/// fitted too.
struct StructuredMeasurements {
  StructuredSignals signals;
  VectorRef network_speed;      // (n)
  VectorRef current;            // (n), or empty
  double current_weight = 1.0;  // standard deviation of the speed's noise over that of the current's
  Feed feed = Feed::measured;   // with `simulated`, network_speed is only what the gauge weighs speeds by
};

/// Batch Levenberg-Marquardt over the structured network. With `gauge` the network is made orthogonal to the linear
/// physics: tau_perp = tau - slope * speed, slope = <tau, speed>/<speed, speed> along the recording, so that v1 carries
/// the whole viscous slope and is determined; without it v1 and the network share the slope, and v1 - B acts as an
/// observer gain.
struct StructuredLevenbergMarquardt {
  int iterations = 60;
  double damping = 1e-3;       // first mu, relative to the scaled J^T J
  double tolerance = 1e-12;    // relative fall of the squared error below which it has converged
  bool gauge = true;
  bool weights_first = true;   // w by least squares before the first iteration
  double ridge = 0.0;          // noise of the speed over the size expected of w: a prior that pulls every w to zero

  struct Result {
    StructuredNetwork network;
    double slope;              // of the network, taken out by the gauge; 0 without it
    FitStatus status;
    std::vector<double> mse;   // before the first and after every accepted iteration
    Vector deviation;          // standard deviation of every parameter for white residuals; 0 where it does not learn
    double condition;          // of the column-scaled Jacobian at the end
  };
  /// `learn`: which parameters move (5 + 4 N_w).
  Result fit(const StructuredNetwork& network, const StructuredMeasurements& data,
             const std::vector<bool>& learn) const;
};

}  // namespace rwn
