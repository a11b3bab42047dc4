#include "rwn/networks/trainers/structured_levenberg_marquardt.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "rwn/networks/trainers/structured_feeds.hpp"
#include "rwn/networks/trainers/structured_problem.hpp"

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
      return "No damping lowers the error: the start is too far off, or the parameters are not determined by this "
             "recording "
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

/// Normal equations with unit columns: (H + mu I) step = g in the scaled parameters.
struct Normal {
  Vector scale, gradient;
  Eigen::MatrixXd H;

  explicit Normal(const StructuredProblem& problem) {
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
StructuredNetwork with_least_squares_weights(const StructuredNetwork& net, const StructuredMeasurements& data,
                                             bool gauge, double ridge, const std::vector<bool>& learn) {
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
  StructuredProblem problem(measured, weights, gauge, ridge);
  if (!std::isfinite(problem.evaluate(net))) {
    return net;
  }
  constexpr double least = 1e-8;  // damping: neighbours may be all but alike
  return {moved(net, problem.which(), Normal(problem).step(least)), net.wavelet()};
}

/// Condition of the scaled Jacobian and standard deviations, residuals taken as white.
void add_uncertainty(StructuredLevenbergMarquardt::Result& out, const StructuredProblem& problem) {
  const Normal normal(problem);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(normal.H);
  const double most = spectrum.eigenvalues().tail(1)[0];
  const double floor = 1e-15 * most;  // rounding hides what lies below
  out.condition = std::sqrt(most / std::max(spectrum.eigenvalues()[0], floor));
  out.deviation = Vector::Zero(out.network.theta().size());
  const double rows = static_cast<double>(problem.residual().size());  // two for a sample where the current is fitted
  const double variance =
      problem.residual().squaredNorm() / std::max(1.0, rows - static_cast<double>(problem.which().size()));
  const Vector weights = spectrum.eigenvalues().cwiseMax(floor).cwiseInverse();
  for (std::size_t i = 0; i < problem.which().size(); ++i) {
    const auto row = spectrum.eigenvectors().row(static_cast<Eigen::Index>(i)).transpose();
    const double inverse = row.cwiseAbs2().dot(weights);
    out.deviation[problem.which()[i]] = std::sqrt(variance * inverse) / normal.scale[static_cast<Eigen::Index>(i)];
  }
}

void check_lengths(const StructuredNetwork& network, const StructuredMeasurements& data,
                   const std::vector<bool>& learn) {
  const StructuredSignals& signals = data.signals;
  check(signals);
  if (data.network_speed.size() != signals.samples() ||
      (data.current.size() > 0 && data.current.size() != signals.samples())) {
    throw std::invalid_argument("network_speed and current: expected one value per sample");
  }
  if (data.feed == Feed::simulated && (network.group(kFeedback).array() != 0.0).any()) {
    throw std::invalid_argument("feed: a network fed with its own speed must be static, c = 0");
  }
  if (learn.size() != static_cast<std::size_t>(network.theta().size()) ||
      std::count(learn.begin(), learn.end(), true) == 0) {
    throw std::invalid_argument("learn: expected one flag per parameter, at least one true");
  }
}

}  // namespace

StructuredLevenbergMarquardt::Result StructuredLevenbergMarquardt::fit(const StructuredNetwork& network,
                                                                       const StructuredMeasurements& data,
                                                                       const std::vector<bool>& learn) const {
  check_lengths(network, data, learn);
  const StructuredSignals& signals = data.signals;
  Result out{weights_first ? with_least_squares_weights(network, data, gauge, ridge, learn) : network, 0.0,
             FitStatus::iteration_limit, {}, {}, 0.0};
  const double n = static_cast<double>(signals.samples());
  StructuredProblem here(data, learn, gauge, ridge), there(data, learn, gauge, ridge);
  double squares = here.evaluate(out.network);
  if (!std::isfinite(squares)) {
    throw std::invalid_argument(
        "network: its plant has an eigenvalue on or outside the unit circle; start from a stable one");
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
        out.status =
            exact || normal.gradient.norm() <= 1e-6 * std::sqrt(squares) ? FitStatus::converged : FitStatus::stuck;
        break;
      }
    }
  }
  out.slope = here.slope();
  add_uncertainty(out, here);
  return out;
}

}  // namespace rwn
