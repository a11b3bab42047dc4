#include "rwn/initialisation/selection.hpp"

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

/// Takes the direction of unit length q out of every column.
void remove(Eigen::Ref<Eigen::MatrixXd> columns, const Eigen::VectorXd& q) { columns -= q * (q.transpose() * columns); }

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
  Eigen::MatrixXd values = candidates(wavelet, library, x);
  const Eigen::VectorXd energy = values.colwise().squaredNorm().transpose();
  Eigen::MatrixXd residual = y;
  const auto take_out = [&](const Eigen::VectorXd& direction) {
    const Eigen::VectorXd q = direction.normalized();
    remove(values, q);
    remove(residual, q);
  };
  Eigen::MatrixXd linear(x.rows(), 1 + x.cols());
  linear << Eigen::VectorXd::Ones(x.rows()), x;
  for (Eigen::Index i = 0; i < linear.cols(); ++i) {
    const Eigen::VectorXd direction = linear.col(i);
    take_out(direction);
    remove(linear, direction.normalized());
  }
  std::vector<int> chosen;
  for (int n = 0; n < wavelets; ++n) {
    const Eigen::ArrayXd left = values.colwise().squaredNorm().transpose();
    const Eigen::ArrayXd explained = (residual.transpose() * values).colwise().squaredNorm().transpose();
    const auto independent = left > 1e-10 * energy.array() + 1e-300;
    Eigen::Index best = 0;
    const double score = independent.select(explained / left.max(1e-300), -1.0).maxCoeff(&best);
    if (score < 0.0) {
      break;
    }
    chosen.push_back(static_cast<int>(best));
    const Eigen::VectorXd direction = values.col(best);
    take_out(direction);
    values.col(best).setZero();
  }
  return chosen;
}

}  // namespace rwn
