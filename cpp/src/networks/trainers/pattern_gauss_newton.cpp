#include "rwn/networks/trainers/pattern_gauss_newton.hpp"

#include <cmath>

namespace rwn {
namespace {

/// Output errors and derivatives of a network at one pattern.
class Pattern {
 public:
  explicit Pattern(const ConventionalShape& shape)
      : row(Eigen::VectorXd::Zero(shape.size())),
        shape_(shape),
        values_(shape.wavelets, shape.inputs),
        slopes_(shape.wavelets, shape.inputs),
        z_(shape.wavelets, shape.inputs) {}

  /// Values and derivatives of all wavelets.
  void place(const ConventionalNetwork& network, const double* x) {
    const ConventionalView n = network.view();
    network.wavelet().visit([&](const auto& wavelet) {
      for (int at = 0; at < shape_.wavelets * shape_.inputs; ++at) {
        const double z = (x[at % shape_.inputs] - n.m[at]) / n.d[at];
        z_.data()[at] = z;
        values_.data()[at] = wavelet.value(z);
        slopes_.data()[at] = wavelet.derivative(z);
      }
    });
  }

  /// Fills row = dyhat_k/dtheta (2.14-2.19) and returns yhat_k.
  double output(const ConventionalNetwork& network, const double* x, int k) {
    const ConventionalView n = network.view();
    row.setZero();
    row[k] = 1.0;
    double y = n.b[k];
    for (int i = 0; i < shape_.inputs; ++i) {
      row[shape_.a() + k * shape_.inputs + i] = x[i];
      y += n.a[k * shape_.inputs + i] * x[i];
    }
    for (int j = 0; j < shape_.wavelets; ++j) {
      const double w = n.w[k * shape_.wavelets + j];
      const double phi = values_.row(j).prod();
      row[shape_.w() + k * shape_.wavelets + j] = phi;
      y += w * phi;
      for (int i = 0; i < shape_.inputs; ++i) {
        const int at = j * shape_.inputs + i;
        row[shape_.m() + at] = -w / n.d[at] * slope(j, i);
        row[shape_.d() + at] = row[shape_.m() + at] * z_(j, i);
      }
    }
    return y;
  }

  Eigen::VectorXd row;

 private:
  double slope(int j, int i) const {
    double product = slopes_(j, i);
    for (int l = 0; l < shape_.inputs; ++l) {
      product *= l == i ? 1.0 : values_(j, l);
    }
    return product;
  }

  ConventionalShape shape_;
  RowMatrix values_, slopes_, z_;
};

/// Square root S of the covariance in units of the noise, and its update for one measured row.
class Covariance {
 public:
  explicit Covariance(const Eigen::VectorXd& deviations)
      : root_(deviations.asDiagonal()), f_(deviations.size()), gain_(deviations.size()) {}

  /// Potter's update; returns the gain K, so that theta += K error.
  const Eigen::VectorXd& update(const Eigen::VectorXd& row, double forgetting) {
    f_.noalias() = root_.transpose() * row;
    gain_.noalias() = root_ * f_;
    const double alpha = forgetting + f_.squaredNorm();
    root_.noalias() -= (gain_ / (alpha + std::sqrt(forgetting * alpha))) * f_.transpose();
    root_ /= std::sqrt(forgetting);
    gain_ /= alpha;
    return gain_;
  }

 private:
  Eigen::MatrixXd root_;
  Eigen::VectorXd f_, gain_;
};

Eigen::VectorXd prior(const ConventionalNetwork& network, const PatternGaussNewton& options) {
  const ConventionalShape& shape = network.shape();
  const int shapes = shape.wavelets * shape.inputs;
  Eigen::VectorXd deviations(shape.size());
  deviations.head(shape.m()).setConstant(options.weight_prior);
  const auto d = network.parameters().tail(shapes).cwiseAbs();
  deviations.segment(shape.m(), shapes) = options.shape_prior * d;
  deviations.tail(shapes) = options.shape_prior * d;
  return deviations / options.noise;
}

}  // namespace

Training PatternGaussNewton::train(ConventionalNetwork network, const RowMatrixRef& x, const RowMatrixRef& y) const {
  const Patterns patterns(x, y);
  const Batch batch(network.shape(), patterns);  // refuses patterns of another shape
  Watch watch(mean_square(patterns), target, stall, iterations);
  Pattern pattern(network.shape());
  Covariance covariance(prior(network, *this));
  const double per_error = 1.0 / (patterns.count() * patterns.outputs());
  for (int n = 0; n < iterations; ++n) {
    double squares = 0.0;
    for (Eigen::Index p = 0; p < x.rows(); ++p) {
      const double* xp = x.data() + p * x.cols();
      for (int k = 0; k < patterns.outputs(); ++k) {
        pattern.place(network, xp);
        const double error = y(p, k) - pattern.output(network, xp, k);
        squares += error * error;
        network.parameters() += covariance.update(pattern.row, forgetting) * error;
      }
    }
    if (watch.stop(squares * per_error, network.parameters())) {
      break;
    }
  }
  return watch.finish(std::move(network), patterns);
}

}  // namespace rwn
