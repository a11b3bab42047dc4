#include "rwn/networks/trainers/structured_feeds.hpp"

#include <stdexcept>
#include <string>

namespace rwn {

Feed feed_by_name(std::string_view name) {
  if (name == "measured") {
    return Feed::measured;
  }
  if (name == "simulated") {
    return Feed::simulated;
  }
  throw std::invalid_argument("feed: expected 'measured' or 'simulated', got '" + std::string(name) + "'");
}

MeasuredFeed::MeasuredFeed(const StructuredNetwork& net, const VectorRef& speed, bool gauge)
    : value_(Vector::Zero(speed.size())), derivative_(speed.size(), 4 * net.wavelets()),
      along_(Eigen::RowVectorXd::Zero(4 * net.wavelets())) {
  net.wavelet().visit([&](const auto& kind) {
    for (Eigen::Index j = 0; j < net.wavelets(); ++j) {
      include(kind, net, speed, j);
    }
  });
  if (gauge) {
    project(speed);
  }
}

template <class W>
void MeasuredFeed::include(const W& kind, const StructuredNetwork& net, const VectorRef& speed, Eigen::Index j) {
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
    value_[n] += w * phi;
    derivative_(n, j) = phi;
    derivative_(n, count + j) = w * V1;
    derivative_(n, 2 * count + j) = w * V2;
    derivative_(n, 3 * count + j) = w * V3;
  }
}

/// Takes the part along the measured speed out of the torque and of its derivatives.
void MeasuredFeed::project(const VectorRef& speed) {
  const double square = speed.squaredNorm();
  if (square == 0.0) {
    return;
  }
  slope_ = speed.dot(value_) / square;
  value_ -= slope_ * speed;
  along_ = (speed.transpose() * derivative_) / square;
  derivative_.noalias() -= speed * along_;
}

SimulatedFeed::SimulatedFeed(const StructuredNetwork& net, double slope)
    : net_(net), slope_(slope), along_(Eigen::RowVectorXd::Zero(4 * net.wavelets())), derivative_(4 * net.wavelets()) {}

SimulatedFeed::SimulatedFeed(const StructuredNetwork& net, const VectorRef& reference, bool gauge)
    : SimulatedFeed(net, 0.0) {
  if (gauge) {
    const MeasuredFeed along_reference(net, reference, true);
    slope_ = along_reference.slope();
    along_ = along_reference.slope_by_parameter();
  }
}

FrictionSample SimulatedFeed::operator()(Eigen::Index, double speed) {
  const Eigen::Index count = net_.wavelets();
  const double* theta = net_.theta().data() + StructuredNetwork::linear;
  double torque = -slope_ * speed, by_speed = -slope_;
  net_.wavelet().visit([&](const auto& kind) {
    for (Eigen::Index j = 0; j < count; ++j) {
      const double w = theta[j], inverse_d = 1.0 / theta[2 * count + j];
      const double z = (speed - theta[count + j]) * inverse_d;
      const double phi = kind.value(z), steep = w * kind.derivative(z) * inverse_d;
      torque += w * phi;
      by_speed += steep;
      derivative_[j] = phi;
      derivative_[count + j] = -steep;
      derivative_[2 * count + j] = -steep * z;
      derivative_[3 * count + j] = 0.0;  // static
    }
  });
  derivative_.noalias() -= speed * along_;
  return {torque, by_speed, derivative_.data()};
}

}  // namespace rwn
