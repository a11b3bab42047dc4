#include "rwn/networks/trainers/structured_problem.hpp"

#include <cmath>
#include <limits>

#include "rwn/kernels/plant_gain.hpp"
#include "rwn/networks/trainers/structured_feeds.hpp"

namespace rwn {

StructuredProblem::StructuredProblem(const StructuredMeasurements& data, const std::vector<bool>& learn, bool gauge,
                                     double ridge)
    : data_(data),
      signals_(data.signals),
      gauge_(gauge),
      outputs_(data.current.size() > 0 ? 2 : 1),
      pull_(ridge * ridge) {
  for (std::size_t k = 0; k < learn.size(); ++k) {
    if (learn[k]) {
      which_.push_back(static_cast<Eigen::Index>(k));
    }
  }
  jacobian_.resize(outputs_ * signals_.samples(), static_cast<Eigen::Index>(which_.size()));
}

void StructuredProblem::take(StructuredProblem& other) {
  jacobian_.swap(other.jacobian_);
  residual_.swap(other.residual_);
  curvature_.swap(other.curvature_);
  gradient_.swap(other.gradient_);
  slope_ = other.slope_;
}

double StructuredProblem::evaluate(const StructuredNetwork& net) {
  const Eigen::Matrix2d a = net.plant();
  if (!(plant_gain(a(0, 0), a(0, 1), a(1, 0), a(1, 1)).spectral_radius < 1.0)) {
    return std::numeric_limits<double>::infinity();
  }
  visit_feed(data_.feed, net, data_.network_speed, gauge_, [&](auto& feed) {
    slope_ = feed.slope();
    filter(net, feed, a);
  });
  const double squares = residual_.squaredNorm() + restrain(net);
  return std::isfinite(squares) ? squares : std::numeric_limits<double>::infinity();
}

/// The ridge: pulls every w that learns to zero. Returns what it costs.
double StructuredProblem::restrain(const StructuredNetwork& net) {
  curvature_.setZero(static_cast<Eigen::Index>(which_.size()));
  gradient_ = curvature_;
  double cost = 0.0;
  for (Eigen::Index i = 0; i < curvature_.size(); ++i) {
    const Eigen::Index k = which_[static_cast<std::size_t>(i)];
    if (k >= net.offset(kWeight) && k < net.offset(kTranslation)) {
      const double w = net.theta()[k];
      curvature_[i] = pull_;
      gradient_[i] = -pull_ * w;
      cost += pull_ * w * w;
    }
  }
  return cost;
}

template <class Feed>
void StructuredProblem::filter(const StructuredNetwork& net, Feed& feed, const Eigen::Matrix2d& a) {
  const double v1 = net.theta()[0], v2 = net.theta()[1], v3 = net.theta()[2], v4 = net.theta()[3];
  const auto p = static_cast<Eigen::Index>(which_.size());
  Eigen::RowVectorXd drive1(p), drive2(p), P = Eigen::RowVectorXd::Zero(p), Q = P, next(p);
  Eigen::RowVector<double, 5> first, second;
  Eigen::Vector2d x = signals_.start;
  residual_.resize(outputs_ * signals_.samples());
  keep(0, x, P, Q);
  for (Eigen::Index n = 1; n < signals_.samples(); ++n) {
    const FrictionSample f = feed(n - 1, x[0]);
    const double tau = f.torque, u = signals_.input[n - 1];
    first << -v2 * x[0], v3 * x[1] - v1 * x[0] - tau, v2 * x[1], 0.0, 0.0;
    second << 0.0, 0.0, -v4 * x[0], u - v3 * x[0], x[1];
    for (Eigen::Index i = 0; i < p; ++i) {
      const Eigen::Index k = which_[static_cast<std::size_t>(i)];
      drive1[i] = k < 5 ? first[k] : -v2 * f.by_parameter[k - 5];
      drive2[i] = k < 5 ? second[k] : 0.0;
    }
    next = (a(0, 0) - v2 * f.by_speed) * P + a(0, 1) * Q + drive1;
    Q = a(1, 0) * P + a(1, 1) * Q + drive2;
    P = next;
    x = Eigen::Vector2d(a(0, 0) * x[0] + a(0, 1) * x[1] - v2 * tau, a(1, 0) * x[0] + a(1, 1) * x[1] + v4 * u);
    keep(n, x, P, Q);
  }
}

/// Residual and Jacobian rows of one sample: the speed's, and behind all of those the weighted current's.
void StructuredProblem::keep(Eigen::Index n, const Eigen::Vector2d& x, const Eigen::RowVectorXd& P,
                             const Eigen::RowVectorXd& Q) {
  jacobian_.row(n) = P;
  residual_[n] = signals_.speed[n] - x[0];
  if (outputs_ == 2) {
    const Eigen::Index second = signals_.samples() + n;
    jacobian_.row(second) = data_.current_weight * Q;
    residual_[second] = data_.current_weight * (data_.current[n] - x[1]);
  }
}

}  // namespace rwn
