#include "rwn/networks/trainers/variable_projection.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

namespace rwn {
namespace {

/// The basis 1, x_i, Phi_j at the current translations and dilations, its factors, and the residual outside its span.
class Projection {
 public:
  Projection(const ConventionalShape& shape, const Patterns& patterns)
      : shape_(shape),
        count_(patterns.count()),
        batch_(shape, patterns),
        basis_(count_, 1 + shape.inputs + shape.wavelets),
        targets_(count_, shape.outputs),
        slopes_(count_, 2 * shape.wavelets * shape.inputs) {
    for (int k = 0; k < shape.outputs; ++k) {
      targets_.col(k) = batch_.target(k);
    }
    basis_.col(0).setOnes();
    for (int i = 0; i < shape.inputs; ++i) {
      basis_.col(1 + i) = batch_.input(i);
    }
  }

  /// Solves for b, a and w into the network; returns the sum of squared errors.
  double solve(ConventionalNetwork& network) {
    batch_.evaluate(network);  // for the wavelets only
    for (int j = 0; j < shape_.wavelets; ++j) {
      basis_.col(1 + shape_.inputs + j) = batch_.phi(j);
    }
    factors_.setThreshold(1e-13);
    factors_.compute(basis_);
    linear_ = factors_.solve(targets_);
    Eigen::VectorXd& theta = network.parameters();
    for (int k = 0; k < shape_.outputs; ++k) {
      theta[k] = linear_(0, k);
      theta.segment(shape_.a() + k * shape_.inputs, shape_.inputs) = linear_.col(k).segment(1, shape_.inputs);
      theta.segment(shape_.w() + k * shape_.wavelets, shape_.wavelets) = linear_.col(k).tail(shape_.wavelets);
    }
    return batch_.evaluate(network);
  }

  /// J^T J and J^T e over m and d, with J_k = P_perp dyhat_k/d(m, d).
  void normal_equations(const ConventionalNetwork& network, Eigen::MatrixXd& squared, Eigen::VectorXd& gradient) {
    const ConventionalView n = network.view();
    const int shapes = shape_.wavelets * shape_.inputs;
    squared.setZero();
    gradient.setZero();
    for (int k = 0; k < shape_.outputs; ++k) {
      for (int at = 0; at < shapes; ++at) {
        const int j = at / shape_.inputs;
        const int i = at % shape_.inputs;
        slopes_.col(at) = (-n.w[k * shape_.wavelets + j] / n.d[at]) * batch_.slope(j, i);
        slopes_.col(shapes + at) =
            slopes_.col(at).cwiseProduct((batch_.input(i).array() - n.m[at]).matrix()) / n.d[at];
      }
      remove_span();
      squared.noalias() += slopes_.transpose() * slopes_;
      gradient.noalias() += slopes_.transpose() * batch_.error(k);
    }
  }

 private:
  /// slopes -= Q Q^T slopes, over the columns of Q that span the basis.
  void remove_span() {
    slopes_.applyOnTheLeft(factors_.householderQ().setLength(factors_.rank()).adjoint());
    slopes_.topRows(factors_.rank()).setZero();
    slopes_.applyOnTheLeft(factors_.householderQ().setLength(factors_.rank()));
  }

  ConventionalShape shape_;
  int count_;
  Batch batch_;
  Eigen::MatrixXd basis_, targets_, linear_, slopes_;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors_;
};

/// Dilations between which a wavelet means something on these patterns, along every input.
struct DilationRange {
  Eigen::VectorXd narrow, wide;

  DilationRange(const Patterns& patterns, double resolution) : narrow(patterns.inputs()), wide(patterns.inputs()) {
    const PatternsView view = patterns.view();
    const double along = std::pow(patterns.count(), 1.0 / patterns.inputs());  // if they filled a grid
    for (int i = 0; i < patterns.inputs(); ++i) {
      const Eigen::Map<const Eigen::VectorXd> x(view.x + i * view.padded, patterns.count());
      const double range = x.maxCoeff() - x.minCoeff();
      narrow[i] = resolution * range / along;
      wide[i] = resolution > 0.0 ? widest * range : std::numeric_limits<double>::infinity();
    }
  }

  void hold(Eigen::VectorXd& parameters, const ConventionalShape& shape) const {
    for (int at = 0; at < shape.wavelets * shape.inputs; ++at) {
      double& d = parameters[shape.d() + at];
      const int i = at % shape.inputs;
      d = std::copysign(std::clamp(std::abs(d), narrow[i], std::max(narrow[i], wide[i])), d);
    }
  }

  static constexpr double widest = 4.0;  // wider wavelets are straight lines over the range, one like the other
};

}  // namespace

Training VariableProjection::train(ConventionalNetwork network, const Patterns& patterns) const {
  const ConventionalShape& shape = network.shape();
  const int shapes = 2 * shape.wavelets * shape.inputs;
  Projection projection(shape, patterns);
  Watch watch(mean_square(patterns), target, stall, iterations);
  const double per_error = 1.0 / (patterns.count() * patterns.outputs());
  Eigen::MatrixXd squared(shapes, shapes);
  Eigen::VectorXd gradient(shapes);
  const DilationRange range(patterns, resolution);
  if (iterations > 0) {
    range.hold(network.parameters(), shape);
  }
  ConventionalNetwork trial = network;
  double squares = projection.solve(network);
  double damping = mu;
  for (int n = 0; !watch.stop(squares * per_error, network.parameters()) && n < iterations; ++n) {
    projection.normal_equations(network, squared, gradient);
    const Eigen::VectorXd scale = squared.diagonal().array() + 1e-12 * squared.diagonal().maxCoeff();
    double tried = squares;
    for (; damping < 1e16; damping *= beta) {
      const Eigen::VectorXd step =
          (squared + (damping * scale).asDiagonal().toDenseMatrix()).ldlt().solve(gradient);
      trial.parameters() = network.parameters();
      trial.parameters().tail(shapes) += step;
      range.hold(trial.parameters(), shape);
      tried = step.allFinite() ? projection.solve(trial) : squares;
      if (tried < squares) {
        break;
      }
    }
    if (!(tried < squares)) {
      watch.status = TrainingStatus::stalled;
      break;
    }
    network.parameters() = trial.parameters();
    squares = tried;
    damping = std::max(damping / beta, 1e-15);
  }
  return watch.finish(std::move(network), patterns);
}

}  // namespace rwn
