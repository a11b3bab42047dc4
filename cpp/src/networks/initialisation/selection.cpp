#include "rwn/networks/initialisation/selection.hpp"

#include <cmath>

namespace rwn {
namespace {

/// Centres and dilations of all scales along one input.
std::vector<std::pair<double, double>> along(double low, double high, int levels, double zeta) {
  std::vector<std::pair<double, double>> nodes;
  for (int level = 0; level < levels; ++level) {
    const double d = zeta * (high - low) / std::ldexp(1.0, level);
    const int steps = static_cast<int>(std::ceil((high - low) / (0.5 * d) - 1e-9));
    for (int s = 0; s <= steps; ++s) {
      nodes.emplace_back(low + (high - low) * s / steps, d);
    }
  }
  return nodes;
}

/// Values of all wavelets of the library at all patterns, (patterns, library).
Eigen::MatrixXd candidates(const Wavelet& wavelet, const Shapes& library, const RowMatrixRef& x) {
  Eigen::MatrixXd values = Eigen::MatrixXd::Ones(x.rows(), library.m.rows());
  wavelet.visit([&](const auto& w) {
    for (Eigen::Index j = 0; j < library.m.rows(); ++j) {
      for (Eigen::Index i = 0; i < x.cols(); ++i) {
        for (Eigen::Index p = 0; p < x.rows(); ++p) {
          values(p, j) *= w.value((x(p, i) - library.m(j, i)) / library.d(j, i));
        }
      }
    }
  });
  return values;
}

/// What is left of y, and of every candidate's squared length, outside the span of the directions taken so far. The
/// candidates themselves stay as they are: the residual is orthogonal to the span, so its products with them are right.
class Remainder {
 public:
  Remainder(const Eigen::MatrixXd& values, const RowMatrixRef& y, Eigen::Index directions)
      : values_(values),
        residual_(y),
        energy_(values.colwise().squaredNorm()),
        left_(energy_),
        span_(y.rows(), directions) {}

  void take_out(Eigen::VectorXd direction) {
    for (int twice = 0; twice < 2; ++twice) {  // once leaves rounding errors of the size of the overlap
      direction -= span_.leftCols(taken_) * (span_.leftCols(taken_).transpose() * direction);
    }
    if (!(direction.norm() > 0.0)) {
      return;
    }
    span_.col(taken_) = direction.normalized();
    const auto q = span_.col(taken_++);
    left_ -= (q.transpose() * values_).array().square().matrix();
    residual_ -= q * (q.transpose() * residual_);
  }

  /// The candidate that explains most of what is left; -1 if none is independent.
  Eigen::Index best() const {
    const Eigen::ArrayXd explained = (residual_.transpose() * values_).colwise().squaredNorm().transpose();
    const Eigen::ArrayXd left = left_.transpose();
    const auto independent = left > 1e-10 * energy_.transpose().array() + 1e-300;
    Eigen::Index at = -1;
    const double score = independent.select(explained / left.max(1e-300), -1.0).maxCoeff(&at);
    return score < 0.0 ? -1 : at;
  }

 private:
  const Eigen::MatrixXd& values_;
  Eigen::MatrixXd residual_;
  Eigen::RowVectorXd energy_, left_;
  Eigen::MatrixXd span_;
  Eigen::Index taken_ = 0;
};

}  // namespace

Shapes wavelet_library(const RowMatrixRef& x, int levels, double zeta) {
  const Domain domain(x);
  std::vector<std::vector<std::pair<double, double>>> axes;
  Eigen::Index total = 1;
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    axes.push_back(along(domain.low[i], domain.high[i], levels, zeta));
    total *= static_cast<Eigen::Index>(axes.back().size());
  }
  Shapes library{RowMatrix(total, x.cols()), RowMatrix(total, x.cols())};
  for (Eigen::Index row = 0; row < total; ++row) {
    std::size_t rest = static_cast<std::size_t>(row);
    for (Eigen::Index i = x.cols() - 1; i >= 0; --i) {  // the last input changes fastest
      const auto& axis = axes[static_cast<std::size_t>(i)];
      const auto [centre, dilation] = axis[rest % axis.size()];
      rest /= axis.size();
      library.m(row, i) = centre;
      library.d(row, i) = dilation;
    }
  }
  return library;
}

std::vector<int> select_wavelets(const Wavelet& wavelet, const Shapes& library, const RowMatrixRef& x,
                                 const RowMatrixRef& y, int wavelets) {
  const Eigen::MatrixXd values = candidates(wavelet, library, x);
  Remainder remainder(values, y, 1 + x.cols() + wavelets);
  remainder.take_out(Eigen::VectorXd::Ones(x.rows()));
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    remainder.take_out(x.col(i));
  }
  std::vector<int> chosen;
  for (int n = 0; n < wavelets; ++n) {
    const Eigen::Index best = remainder.best();
    if (best < 0) {
      break;
    }
    chosen.push_back(static_cast<int>(best));
    remainder.take_out(values.col(best));
  }
  return chosen;
}

}  // namespace rwn
