// What every trainer of a static network returns.
#pragma once

#include <string_view>
#include <vector>

#include "rwn/networks/conventional_network.hpp"

namespace rwn {

enum class TrainingStatus { converged, iteration_limit, stalled, diverged };

std::string_view to_string(TrainingStatus status);
/// What happened and what to try, in one sentence.
std::string_view advice(TrainingStatus status);

struct Training {
  ConventionalNetwork network;  // the last one; of a diverged run the best one
  std::vector<double> mse;      // history, by iteration
  double frozen_mse;            // of `network` with its weights held
  TrainingStatus status;
};

/// Judges a history of MSEs while it grows, and keeps the best parameters for a run that diverges.
class Watch {
 public:
  /// \param scale a mean square of the wanted outputs: what counts as large
  /// \param target MSE at which to stop  \param stall relative change over `window` iterations below which to stop
  Watch(double scale, double target, double stall, int iterations);

  /// Records the MSE of these parameters; true when the run should stop.
  bool stop(double mse, const Eigen::VectorXd& parameters);
  /// Ends the run at this network (at its best parameters if it diverged).
  Training finish(ConventionalNetwork network, const Patterns& patterns);

  TrainingStatus status = TrainingStatus::iteration_limit;

 private:
  static constexpr std::size_t window = 100;
  double limit_, target_, stall_, best_mse_;
  std::vector<double> mse_;
  Eigen::VectorXd best_;
};

/// Mean over patterns and outputs of y^2.
double mean_square(const Patterns& patterns);

}  // namespace rwn
