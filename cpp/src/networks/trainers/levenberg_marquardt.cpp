#include "rwn/networks/trainers/levenberg_marquardt.hpp"

#include <Eigen/Cholesky>

namespace rwn {
namespace {

/// Normal equations J^T J and J^T e of one iteration, and damped steps from them.
struct NormalEquations {
  Eigen::MatrixXd jacobian, squared, damped;
  Eigen::VectorXd gradient, step;
  Eigen::LLT<Eigen::MatrixXd> factors;

  NormalEquations(Eigen::Index rows, Eigen::Index n)
      : jacobian(rows, n), squared(n, n), damped(n, n), gradient(n), step(n), factors(n) {}

  void form(const ConventionalNetwork& network, Batch& batch) {
    batch.jacobian(network, jacobian);
    squared.noalias() = jacobian.transpose() * jacobian;
    batch.descent(network, gradient);
  }
  bool solve(double mu) {
    damped = squared;
    damped.diagonal().array() += mu;
    factors.compute(damped);
    step = factors.solve(gradient);
    return factors.info() == Eigen::Success && step.allFinite();
  }
};

}  // namespace

Training LevenbergMarquardt::train(ConventionalNetwork network, const Patterns& patterns) const {
  Batch batch(network.shape(), patterns);
  Watch watch(mean_square(patterns), target, stall, iterations);
  NormalEquations normal(patterns.count() * patterns.outputs(), network.shape().size());
  const double per_error = 1.0 / (patterns.count() * patterns.outputs());
  double squares = batch.evaluate(network);
  double damping = mu;
  Eigen::VectorXd held = network.parameters();
  for (int n = 0; !watch.stop(squares * per_error, network.parameters()) && n < iterations; ++n) {
    normal.form(network, batch);
    const double most = 1e10 * normal.squared.diagonal().maxCoeff();
    held = network.parameters();
    double tried = squares;
    for (; damping < most; damping *= beta) {
      const bool solved = normal.solve(damping);
      network.parameters() = held + normal.step;
      tried = solved ? batch.evaluate(network) : squares;
      if (tried < squares) {
        break;
      }
    }
    if (!(tried < squares)) {
      network.parameters() = held;
      watch.status = TrainingStatus::stalled;
      break;
    }
    squares = tried;
    damping /= beta;
  }
  return watch.finish(std::move(network), patterns);
}

}  // namespace rwn
