#include "rwn/networks/trainers/recursive_gauss_newton.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "rwn/kernels/plant_gain.hpp"

namespace rwn {
namespace {

/// The square root S of the covariance over the parameters that learn, and everything one correction needs.
class SquareRoot {
 public:
  SquareRoot(const VectorRef& spread, const StructuredNetwork& network)
      : all_(spread.size()), change_(Vector::Zero(spread.size())) {
    for (Eigen::Index k = 0; k < spread.size(); ++k) {
      if (spread[k] > 0.0) {
        which_.push_back(k);
        const bool dilation = k >= network.offset(kDilation) && k < network.offset(kFeedback);
        positive_.push_back((k >= kV2 && k <= kV4) || dilation);
      }
    }
    const auto p = static_cast<Eigen::Index>(which_.size());
    first_.resize(p);
    for (Eigen::Index i = 0; i < p; ++i) {
      first_[i] = spread[which_[static_cast<std::size_t>(i)]];
    }
    reset();
    phi_.resize(p);
    f_.resize(p);
    gain_.resize(p);
  }

  /// The change of all parameters for an error, limited; S is updated.
  const Vector& correct(StructuredRun& run, const Vector& theta, double error, double r, double underweighting,
                        double lambda) {
    run.speed_sensitivity(all_.data());
    for (std::size_t i = 0; i < which_.size(); ++i) {
      phi_[static_cast<Eigen::Index>(i)] = all_[which_[i]];
    }
    f_.noalias() = S_.transpose() * phi_;
    const double trusted = lambda * r + underweighting * f_.squaredNorm();
    const double alpha = trusted + f_.squaredNorm();
    gain_.noalias() = S_ * f_;
    if (spread_change(theta, error / alpha)) {
      S_.noalias() -= gain_ * (f_.transpose() / (alpha + std::sqrt(alpha * trusted)));
      if (lambda < 1.0) {
        S_ *= 1.0 / std::sqrt(lambda);
      }
    }
    return change_;
  }

  const std::vector<Eigen::Index>& which() const { return which_; }
  void reset() { S_ = first_.asDiagonal(); }

 private:
  /// Fills change_; false if it had to be cut short.
  bool spread_change(const Vector& theta, double step) {
    double allowed = 1.0;
    for (std::size_t i = 0; i < which_.size(); ++i) {
      const double move = step * gain_[static_cast<Eigen::Index>(i)];
      change_[which_[i]] = move;
      if (positive_[i] && std::abs(move) > 0.5 * std::abs(theta[which_[i]])) {
        allowed = std::min(allowed, 0.5 * std::abs(theta[which_[i]]) / std::abs(move));
      }
    }
    if (allowed < 1.0) {
      change_ *= allowed;
    }
    return allowed == 1.0;
  }

  std::vector<Eigen::Index> which_;
  std::vector<bool> positive_;
  Vector all_, change_, first_, phi_, f_, gain_;
  Eigen::MatrixXd S_;
};

/// Standard deviations from one pass over the recording: (J^T J / r + diag(1 / spread^2))^-1, scaled by the spread.
Vector deviations(const StructuredNetwork& network, const StructuredSignals& signals, const VectorRef& spread,
                  const std::vector<Eigen::Index>& which, double noise) {
  const RowMatrix jacobian = sensitivities(network, signals).jacobian;
  const auto p = static_cast<Eigen::Index>(which.size());
  RowMatrix scaled(jacobian.rows(), p);
  for (Eigen::Index i = 0; i < p; ++i) {
    const Eigen::Index k = which[static_cast<std::size_t>(i)];
    scaled.col(i) = jacobian.col(k) * (spread[k] / noise);
  }
  Eigen::MatrixXd information = Eigen::MatrixXd::Identity(p, p);
  information.selfadjointView<Eigen::Lower>().rankUpdate(scaled.transpose());
  const Eigen::MatrixXd covariance =
      information.selfadjointView<Eigen::Lower>().llt().solve(Eigen::MatrixXd::Identity(p, p));
  Vector out = Vector::Zero(spread.size());
  for (Eigen::Index i = 0; i < p; ++i) {
    const Eigen::Index k = which[static_cast<std::size_t>(i)];
    out[k] = spread[k] * std::sqrt(covariance(i, i));
  }
  return out;
}

/// Refuses options and deviations that no recursion can run with.
void check_options(const RecursiveGaussNewton& options, const VectorRef& spread, Eigen::Index parameters) {
  if (spread.size() != parameters || !(spread.array() >= 0.0).all() || !(spread.maxCoeff() > 0.0)) {
    throw std::invalid_argument("spread: expected one standard deviation >= 0 per parameter, at least one above 0");
  }
  if (!(options.noise > 0.0) || !(options.underweighting >= 0.0) ||
      !(options.forgetting > 0.0 && options.forgetting <= 1.0) ||
      !(options.forgetting_decay >= 0.0 && options.forgetting_decay <= 1.0) || options.cycles < 1) {
    throw std::invalid_argument(
        "noise must be positive, underweighting at least 0, forgetting in (0, 1], forgetting_decay in [0, 1] and "
        "cycles at "
        "least 1");
  }
}

/// Mean squared error without learning; infinite where a parameter has left the numbers or a wavelet has no width.
double frozen_error(const Vector& theta, const StructuredNetwork& network, const StructuredSignals& signals) {
  const bool sound =
      theta.allFinite() && (theta.segment(network.offset(kDilation), network.wavelets()).array() != 0.0).all();
  return sound ? mean_squared_error({theta, network.wavelet()}, signals) : std::numeric_limits<double>::infinity();
}

}  // namespace

RecursiveGaussNewton::Result RecursiveGaussNewton::train(const StructuredNetwork& network,
                                                         const StructuredSignals& signals,
                                                         const VectorRef& spread) const {
  check(signals);
  check_options(*this, spread, network.theta().size());
  Result out{network, {}, {}};
  OnlineHistory& history = out.history;
  StructuredRun run(network);
  run.want(spread[kV4] > 0.0 || spread[kV5] > 0.0,
           network.wavelets() > 0 && spread.tail(4 * network.wavelets()).maxCoeff() > 0.0);
  run.follow(follow_state);
  SquareRoot root(spread, network);
  const double samples = static_cast<double>(signals.samples());
  history.frozen_after.push_back(0);
  history.mse_frozen.push_back(mean_squared_error(network, signals));
  bool improved = false;
  Vector theta = network.theta();
  double frozen = history.mse_frozen[0], wary = underweighting, forget = 1.0 - forgetting;
  for (int done = 1; done <= cycles; ++done) {
    run.restart(signals.start);
    double squares = std::pow(signals.speed[0] - run.speed(), 2);
    for (Eigen::Index n = 1; n < signals.samples(); ++n) {
      run.advance(signals.input[n - 1], signals.speed[n - 1]);
      const double error = signals.speed[n] - run.speed();
      squares += error * error;
      const Vector& change = root.correct(run, theta, error, noise * noise, wary, 1.0 - forget);
      theta += change;
      run.shift(change);
    }
    history.mse_learning.push_back(squares / samples);
    const double mse = frozen_error(theta, network, signals);
    if (mse <= (improved ? 1.1 : 1.0) * frozen) {
      out.network = StructuredNetwork(theta, network.wavelet());
      improved = true;
      frozen = mse;
      wary *= forgetting_decay;
      forget *= forgetting_decay;
    } else {  // the frozen error grew: undo the cycle and try again with smaller corrections
      theta = out.network.theta();
      run.load(out.network);
      root.reset();
      wary = 10.0 * std::max(wary, 0.1);
    }
    history.parameters.emplace_back(theta.data(), theta.data() + StructuredNetwork::linear);
    const Eigen::Matrix2d a = out.network.plant();
    const PlantGain gain = plant_gain(a(0, 0), a(0, 1), a(1, 0), a(1, 1));
    history.report.include(gain.spectral_radius, gain.condition);
    watch(history.report, run, network.wavelet().max_derivative());
    if (done == cycles || (frozen_every > 0 && done % frozen_every == 0)) {
      history.frozen_after.push_back(done);
      history.mse_frozen.push_back(frozen);
    }
    history.status = gain.spectral_radius >= 1.0 ? OnlineStatus::unstable
                     : improved                  ? OnlineStatus::completed
                                                 : OnlineStatus::diverged;
  }
  out.deviation = deviations(out.network, signals, spread, root.which(), noise);
  return out;
}

}  // namespace rwn
