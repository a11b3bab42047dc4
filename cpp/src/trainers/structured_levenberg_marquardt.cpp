#include "rwn/trainers/structured_levenberg_marquardt.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "rwn/plant_gain.hpp"
#include "rwn/trainers/structured_feeds.hpp"

namespace rwn {

std::string_view to_string(FitStatus status) {
  switch (status) {
    case FitStatus::converged:
      return "converged";
    case FitStatus::stuck:
      return "stuck";
    case FitStatus::iteration_limit:
      break;
  }
  return "iteration-limit";
}

std::string_view advice(FitStatus status) {
  switch (status) {
    case FitStatus::converged:
      return "The squared error no longer falls: a minimum was reached.";
    case FitStatus::stuck:
      return "No damping lowers the error: the start is too far off, or the parameters are not determined by this recording "
             "(see condition and deviation); free fewer groups or excite more.";
    case FitStatus::iteration_limit:
      break;
  }
  return "The iterations were used up while the error still fell: allow more.";
}

Vector simulate_fed_back(const StructuredNetwork& network, double slope, const StructuredSignals& signals) {
  check(signals);
  const Eigen::Matrix2d a = network.plant();
  const double v2 = network.theta()[1], v4 = network.theta()[3];
  SimulatedFeed feed(network, slope);
  Eigen::Vector2d x = signals.start;
  Vector out(signals.samples());
  out[0] = x[0];
  for (Eigen::Index n = 1; n < out.size(); ++n) {
    const double tau = feed(n - 1, x[0]).torque;
    x = Eigen::Vector2d(a(0, 0) * x[0] + a(0, 1) * x[1] - v2 * tau,
                        a(1, 0) * x[0] + a(1, 1) * x[1] + v4 * signals.input[n - 1]);
    out[n] = x[0];
  }
  return out;
}

Vector simulate_plant(const StructuredNetwork& network, const StructuredSignals& signals, const VectorRef& torque) {
  check(signals);
  if (torque.size() != signals.samples()) {
    throw std::invalid_argument("torque: expected one value per sample");
  }
  const Eigen::Matrix2d a = network.plant();
  const double v2 = network.theta()[1], v4 = network.theta()[3];
  Eigen::Vector2d x = signals.start;
  Vector out(signals.samples());
  out[0] = x[0];
  for (Eigen::Index n = 1; n < out.size(); ++n) {
    x = Eigen::Vector2d(a(0, 0) * x[0] + a(0, 1) * x[1] - v2 * torque[n - 1],
                        a(1, 0) * x[0] + a(1, 1) * x[1] + v4 * signals.input[n - 1]);
    out[n] = x[0];
  }
  return out;
}

namespace {

/// Residual e = y - x1 and Jacobian dx1/dtheta (n, learning parameters) of a network.
class Problem {
 public:
  Problem(const StructuredMeasurements& data, const std::vector<bool>& learn, bool gauge, double ridge)
      : data_(data), signals_(data.signals), gauge_(gauge), outputs_(data.current.size() > 0 ? 2 : 1),
        pull_(ridge * ridge) {
    for (std::size_t k = 0; k < learn.size(); ++k) {
      if (learn[k]) {
        which_.push_back(static_cast<Eigen::Index>(k));
      }
    }
    jacobian_.resize(outputs_ * signals_.samples(), static_cast<Eigen::Index>(which_.size()));
  }

  const std::vector<Eigen::Index>& which() const { return which_; }
  const RowMatrix& jacobian() const { return jacobian_; }
  const Vector& residual() const { return residual_; }
  double slope() const { return slope_; }
  /// What the ridge adds to the normal equations: its curvature by every learning parameter, and its gradient.
  const Vector& curvature() const { return curvature_; }
  const Vector& gradient() const { return gradient_; }

  /// Takes over the residual and the Jacobian of another point.
  void take(Problem& other) {
    jacobian_.swap(other.jacobian_);
    residual_.swap(other.residual_);
    curvature_.swap(other.curvature_);
    gradient_.swap(other.gradient_);
    slope_ = other.slope_;
  }
  /// Sum of squared errors with the ridge, or infinity where the plant is not stable.
  double evaluate(const StructuredNetwork& net) {
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

 private:
  /// The ridge: pulls every w that learns to zero. Returns what it costs.
  double restrain(const StructuredNetwork& net) {
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
  void filter(const StructuredNetwork& net, Feed& feed, const Eigen::Matrix2d& a) {
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
  void keep(Eigen::Index n, const Eigen::Vector2d& x, const Eigen::RowVectorXd& P, const Eigen::RowVectorXd& Q) {
    jacobian_.row(n) = P;
    residual_[n] = signals_.speed[n] - x[0];
    if (outputs_ == 2) {
      const Eigen::Index second = signals_.samples() + n;
      jacobian_.row(second) = data_.current_weight * Q;
      residual_[second] = data_.current_weight * (data_.current[n] - x[1]);
    }
  }

  const StructuredMeasurements& data_;
  const StructuredSignals& signals_;
  bool gauge_;
  Eigen::Index outputs_;
  std::vector<Eigen::Index> which_;
  RowMatrix jacobian_;
  Vector residual_;
  double pull_;
  Vector curvature_, gradient_;
  double slope_ = 0.0;
};

/// Normal equations with unit columns: (H + mu I) step = g in the scaled parameters.
struct Normal {
  Vector scale, gradient;
  Eigen::MatrixXd H;

  explicit Normal(const Problem& problem) {
    const RowMatrix& J = problem.jacobian();
    H.setZero(J.cols(), J.cols());
    H.selfadjointView<Eigen::Lower>().rankUpdate(J.transpose());
    H.diagonal() += problem.curvature();
    scale = H.diagonal().cwiseSqrt();
    scale = (scale.array() > 0.0).select(scale, 1.0);
    H = H.selfadjointView<Eigen::Lower>();
    H = (scale.cwiseInverse().asDiagonal() * H * scale.cwiseInverse().asDiagonal()).eval();
    gradient = (J.transpose() * problem.residual() + problem.gradient()).cwiseQuotient(scale);
  }
  Vector step(double damping) const {
    Eigen::MatrixXd damped = H;
    damped.diagonal().array() += damping;
    return damped.ldlt().solve(gradient).cwiseQuotient(scale);
  }
};

bool keeps_signs(const StructuredNetwork& net, const Vector& theta) {
  for (Eigen::Index k = kV2; k <= kV4; ++k) {
    if (!(net.theta()[k] * theta[k] > 0.0)) {
      return false;
    }
  }
  const Eigen::Index first = net.offset(kDilation), size = net.wavelets();
  return size == 0 || (net.theta().segment(first, size).array() * theta.segment(first, size).array() > 0.0).all();
}

Vector moved(const StructuredNetwork& net, const std::vector<Eigen::Index>& which, const Vector& step) {
  Vector theta = net.theta();
  for (std::size_t i = 0; i < which.size(); ++i) {
    theta[which[i]] += step[static_cast<Eigen::Index>(i)];
  }
  return theta;
}

/// The output is linear in w: one ridge least-squares step finds it.
StructuredNetwork with_least_squares_weights(const StructuredNetwork& net, const StructuredMeasurements& data, bool gauge,
                                             double ridge, const std::vector<bool>& learn) {
  StructuredMeasurements measured = data;
  measured.feed = Feed::measured;  // fed with itself, the output would not be linear in w
  std::vector<bool> weights(learn.size(), false);
  bool any = false;
  for (Eigen::Index k = net.offset(kWeight); k < net.offset(kTranslation); ++k) {
    any = any || learn[static_cast<std::size_t>(k)];
    weights[static_cast<std::size_t>(k)] = learn[static_cast<std::size_t>(k)];
  }
  if (!any) {
    return net;
  }
  Problem problem(measured, weights, gauge, ridge);
  if (!std::isfinite(problem.evaluate(net))) {
    return net;
  }
  constexpr double least = 1e-8;  // damping: neighbours may be all but alike
  return {moved(net, problem.which(), Normal(problem).step(least)), net.wavelet()};
}

}  // namespace

StructuredLevenbergMarquardt::Result StructuredLevenbergMarquardt::fit(const StructuredNetwork& network,
                                                                       const StructuredMeasurements& data,
                                                                       const std::vector<bool>& learn) const {
  const StructuredSignals& signals = data.signals;
  check(signals);
  if (data.network_speed.size() != signals.samples() ||
      (data.current.size() > 0 && data.current.size() != signals.samples())) {
    throw std::invalid_argument("network_speed and current: expected one value per sample");
  }
  if (data.feed == Feed::simulated && (network.group(kFeedback).array() != 0.0).any()) {
    throw std::invalid_argument("feed: a network fed with its own speed must be static, c = 0");
  }
  if (learn.size() != static_cast<std::size_t>(network.theta().size()) || std::count(learn.begin(), learn.end(), true) == 0) {
    throw std::invalid_argument("learn: expected one flag per parameter, at least one true");
  }
  Result out{weights_first ? with_least_squares_weights(network, data, gauge, ridge, learn) : network, 0.0,
             FitStatus::iteration_limit, {}, {}, 0.0};
  const double n = static_cast<double>(signals.samples());
  Problem here(data, learn, gauge, ridge), there(data, learn, gauge, ridge);
  double squares = here.evaluate(out.network);
  if (!std::isfinite(squares)) {
    throw std::invalid_argument("network: its plant has an eigenvalue on or outside the unit circle; start from a stable one");
  }
  out.mse.push_back(here.residual().squaredNorm() / n);
  double mu = damping, growth = 2.0;
  Normal normal(here);
  for (int k = 0; k < iterations;) {
    const Vector step = normal.step(mu);
    const Vector theta = moved(out.network, here.which(), step);
    const bool legal = theta.allFinite() && keeps_signs(out.network, theta);
    const double trial = legal ? there.evaluate({theta, network.wavelet()}) : std::numeric_limits<double>::infinity();
    if (trial < squares) {
      const Vector scaled = step.cwiseProduct(normal.scale);
      const double gain = (squares - trial) / scaled.dot(mu * scaled + normal.gradient);
      mu *= std::max(1.0 / 3.0, 1.0 - std::pow(2.0 * gain - 1.0, 3));
      growth = 2.0;
      const bool settled = squares - trial <= tolerance * squares;
      squares = trial;
      out.network = StructuredNetwork(theta, network.wavelet());
      here.take(there);
      out.mse.push_back(here.residual().squaredNorm() / n);
      ++k;
      if (settled) {
        out.status = FitStatus::converged;
        break;
      }
      normal = Normal(here);
    } else {
      mu *= growth;
      growth *= 2.0;
      if (mu > 1e12) {  // at a minimum, or where rounding hides every descent
        const bool exact = squares <= 1e-24 * signals.speed.squaredNorm();
        out.status = exact || normal.gradient.norm() <= 1e-6 * std::sqrt(squares) ? FitStatus::converged : FitStatus::stuck;
        break;
      }
    }
  }
  out.slope = here.slope();
  normal = Normal(here);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(normal.H);
  const double most = spectrum.eigenvalues().tail(1)[0];
  const double floor = 1e-15 * most;  // rounding hides what lies below
  out.condition = std::sqrt(most / std::max(spectrum.eigenvalues()[0], floor));
  out.deviation = Vector::Zero(network.theta().size());
  const double rows = static_cast<double>(here.residual().size());  // twice the samples where the current is fitted too
  const double variance = here.residual().squaredNorm() / std::max(1.0, rows - static_cast<double>(here.which().size()));
  const Vector weights = spectrum.eigenvalues().cwiseMax(floor).cwiseInverse();
  for (std::size_t i = 0; i < here.which().size(); ++i) {
    const auto row = spectrum.eigenvectors().row(static_cast<Eigen::Index>(i)).transpose();
    const double inverse = row.cwiseAbs2().dot(weights);
    out.deviation[here.which()[i]] = std::sqrt(variance * inverse) / normal.scale[static_cast<Eigen::Index>(i)];
  }
  return out;
}

}  // namespace rwn
