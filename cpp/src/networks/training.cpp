#include "rwn/networks/training.hpp"

#include <cmath>
#include <limits>

namespace rwn {

std::string_view to_string(TrainingStatus status) {
  switch (status) {
    case TrainingStatus::converged:
      return "converged";
    case TrainingStatus::stalled:
      return "stalled";
    case TrainingStatus::diverged:
      return "diverged";
    case TrainingStatus::iteration_limit:
      break;
  }
  return "iteration-limit";
}

std::string_view advice(TrainingStatus status) {
  switch (status) {
    case TrainingStatus::converged:
      return "The target or a minimum was reached.";
    case TrainingStatus::stalled:
      return "The error no longer changes: start from another initialisation (selection), or add wavelets.";
    case TrainingStatus::diverged:
      return "The error grew without bound and the best network met is returned: lower the rate or the momentum, or "
             "scale "
             "the inputs to [-1, 1].";
    case TrainingStatus::iteration_limit:
      break;
  }
  return "The iterations were used up while the error still fell: allow more, or take variable projection.";
}

double mean_square(const Patterns& patterns) {
  return patterns.outputs_matrix().squaredNorm() / (patterns.count() * patterns.outputs());
}

Watch::Watch(double scale, double target, double stall, int iterations)
    : limit_(1e6 * scale), target_(target), stall_(stall), best_mse_(std::numeric_limits<double>::infinity()) {
  mse_.reserve(static_cast<std::size_t>(iterations) + 1);
}

bool Watch::stop(double mse, const Eigen::VectorXd& parameters) {
  mse_.push_back(mse);
  if (mse_.size() == 1) {
    limit_ += 1e6 * mse;
  }
  if (!(mse <= limit_) || !parameters.allFinite()) {
    status = TrainingStatus::diverged;
    return true;
  }
  if (mse < best_mse_) {
    best_mse_ = mse;
    best_ = parameters;
  }
  if (mse <= target_) {
    status = TrainingStatus::converged;
    return true;
  }
  if (mse_.size() > window && std::abs(mse - mse_[mse_.size() - 1 - window]) <= stall_ * mse) {
    status = TrainingStatus::stalled;
    return true;
  }
  return false;
}

Training Watch::finish(ConventionalNetwork network, const Patterns& patterns) {
  if (status == TrainingStatus::diverged && best_.size() > 0) {
    network.parameters() = best_;
  }
  Batch batch(network.shape(), patterns);
  const double squares = batch.evaluate(network);
  return {std::move(network), std::move(mse_), squares / (patterns.count() * patterns.outputs()), status};
}

}  // namespace rwn
