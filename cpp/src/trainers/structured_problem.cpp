#include "rwn/trainers/structured_problem.hpp"

#include <limits>

#include "rwn/plant_gain.hpp"

namespace rwn {
namespace {

template <class W>
void add_wavelet(const W& kind, const StructuredNetwork& net, const VectorRef& speed, Eigen::Index j, FrictionTorque& torque) {
  const Eigen::Index count = net.wavelets();
  const double w = net.group(kWeight)[j], m = net.group(kTranslation)[j];
  const double d = net.group(kDilation)[j], c = net.group(kFeedback)[j];
  double phi = 0.0, V1 = 0.0, V2 = 0.0, V3 = 0.0;
  for (Eigen::Index n = 0; n < speed.size(); ++n) {
    const double z = (speed[n] + c * phi - m) / d;
    const double steep = kind.derivative(z) / d;
    V1 = steep * (c * V1 - 1.0);
    V2 = steep * (c * V2 - z);
    V3 = steep * (c * V3 + phi);
    phi = kind.value(z);
    torque.value[n] += w * phi;
    torque.slope(n, j) = phi;
    torque.slope(n, count + j) = w * V1;
    torque.slope(n, 2 * count + j) = w * V2;
    torque.slope(n, 3 * count + j) = w * V3;
  }
}

}  // namespace

FrictionTorque::FrictionTorque(const StructuredNetwork& net, const VectorRef& speed)
    : value(Vector::Zero(speed.size())), slope(speed.size(), 4 * net.wavelets()) {
  net.wavelet().visit([&](const auto& kind) {
    for (Eigen::Index j = 0; j < net.wavelets(); ++j) {
      add_wavelet(kind, net, speed, j, *this);
    }
  });
}

double FrictionTorque::project(const VectorRef& speed) {
  const double square = speed.squaredNorm();
  if (square == 0.0) {
    return 0.0;
  }
  const double k = speed.dot(value) / square;
  value -= k * speed;
  const Eigen::RowVectorXd along = (speed.transpose() * slope) / square;
  slope.noalias() -= speed * along;
  return k;
}

StructuredProblem::StructuredProblem(const StructuredMeasurements& data, const std::vector<bool>& learn, bool gauge)
    : data_(data), signals_(data.signals), gauge_(gauge), outputs_(data.current.size() > 0 ? 2 : 1) {
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
  slope_ = other.slope_;
}

double StructuredProblem::evaluate(const StructuredNetwork& net) {
  const Eigen::Matrix2d a = net.plant();
  if (!(plant_gain(a(0, 0), a(0, 1), a(1, 0), a(1, 1)).spectral_radius < 1.0)) {
    return std::numeric_limits<double>::infinity();
  }
  FrictionTorque torque(net, data_.network_speed);
  slope_ = gauge_ ? torque.project(data_.network_speed) : 0.0;
  filter(net, torque, a);
  return residual_.squaredNorm();
}

void StructuredProblem::filter(const StructuredNetwork& net, const FrictionTorque& torque, const Eigen::Matrix2d& a) {
  const double v1 = net.theta()[0], v2 = net.theta()[1], v3 = net.theta()[2], v4 = net.theta()[3];
  const auto p = static_cast<Eigen::Index>(which_.size());
  Eigen::RowVectorXd drive1(p), drive2(p), P = Eigen::RowVectorXd::Zero(p), Q = P, next(p);
  Eigen::RowVector<double, 5> first, second;
  Eigen::Vector2d x = signals_.start;
  residual_.resize(outputs_ * signals_.samples());
  keep(0, x, P, Q);
  for (Eigen::Index n = 1; n < signals_.samples(); ++n) {
    const double tau = torque.value[n - 1], u = signals_.input[n - 1];
    first << -v2 * x[0], v3 * x[1] - v1 * x[0] - tau, v2 * x[1], 0.0, 0.0;
    second << 0.0, 0.0, -v4 * x[0], u - v3 * x[0], x[1];
    for (Eigen::Index i = 0; i < p; ++i) {
      const Eigen::Index k = which_[static_cast<std::size_t>(i)];
      drive1[i] = k < 5 ? first[k] : -v2 * torque.slope(n - 1, k - 5);
      drive2[i] = k < 5 ? second[k] : 0.0;
    }
    next = a(0, 0) * P + a(0, 1) * Q + drive1;
    Q = a(1, 0) * P + a(1, 1) * Q + drive2;
    P = next;
    x = Eigen::Vector2d(a(0, 0) * x[0] + a(0, 1) * x[1] - v2 * tau, a(1, 0) * x[0] + a(1, 1) * x[1] + v4 * u);
    keep(n, x, P, Q);
  }
}

/// Residual and Jacobian rows of one sample: the speed's, and behind all of those the weighted current's.
void StructuredProblem::keep(Eigen::Index n, const Eigen::Vector2d& x, const Eigen::RowVectorXd& P, const Eigen::RowVectorXd& Q) {
  jacobian_.row(n) = P;
  residual_[n] = signals_.speed[n] - x[0];
  if (outputs_ == 2) {
    const Eigen::Index second = signals_.samples() + n;
    jacobian_.row(second) = data_.current_weight * Q;
    residual_[second] = data_.current_weight * (data_.current[n] - x[1]);
  }
}

}  // namespace rwn
