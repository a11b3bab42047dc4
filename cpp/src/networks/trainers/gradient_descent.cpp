#include "rwn/networks/trainers/gradient_descent.hpp"

namespace rwn {

Training GradientDescent::train(ConventionalNetwork network, const Patterns& patterns) const {
  Batch batch(network.shape(), patterns);
  Watch watch(mean_square(patterns), target, stall, iterations);
  Eigen::VectorXd descent(network.shape().size());
  Eigen::VectorXd step = Eigen::VectorXd::Zero(network.shape().size());
  const double per_error = 1.0 / (patterns.count() * patterns.outputs());
  for (int n = 0;; ++n) {
    const double mse = batch.evaluate(network) * per_error;
    if (watch.stop(mse, network.parameters()) || n == iterations) {
      break;
    }
    batch.descent(network, descent);
    step = (rate / patterns.count()) * descent + momentum * step;
    network.parameters() += step;
  }
  return watch.finish(std::move(network), patterns);
}

}  // namespace rwn
