#include "rwn/networks/online_training.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

#include "rwn/networks/plant_analysis.hpp"

namespace rwn {

std::string_view to_string(OnlineStatus status) {
  switch (status) {
    case OnlineStatus::stalled:
      return "stalled";
    case OnlineStatus::unstable:
      return "unstable";
    case OnlineStatus::diverged:
      return "diverged";
    case OnlineStatus::completed:
      break;
  }
  return "completed";
}

std::string_view advice(OnlineStatus status) {
  switch (status) {
    case OnlineStatus::stalled:
      return "The parameters no longer move though an error is left: see the report for a defective M or |c/d| >= 1, "
             "take "
             "rates from a pre-pass, or the recursive Gauss-Newton trainer.";
    case OnlineStatus::unstable:
      return "The learned plant has an eigenvalue on or outside the unit circle, so no rate bound holds: start nearer "
             "to "
             "the truth, lower the fraction, or sample faster.";
    case OnlineStatus::diverged:
      return "The error grew without bound and the parameters before that cycle are returned: lower the fraction, "
             "share "
             "the rates, follow the state, or take the recursive Gauss-Newton trainer.";
    case OnlineStatus::completed:
      break;
  }
  return "Every cycle was run; judge the network by its frozen error, not by the error while learning.";
}

double divergence_limit(double mean_square, double first_mse) { return 1e6 * (mean_square + first_mse); }

bool stands_still(const VectorRef& before, const VectorRef& after) {
  return ((after - before).array().abs() <= 1e-12 * before.array().abs()).all();
}

OnlineWatch::OnlineWatch(OnlineHistory& history, double mean_square, double first_mse)
    : history_(history), limit_(divergence_limit(mean_square, first_mse)) {}

bool OnlineWatch::diverged(double mse, const Vector& theta) {
  history_.mse_learning.push_back(mse);
  if (mse <= limit_ && theta.allFinite()) {
    return false;
  }
  history_.status = OnlineStatus::diverged;
  return true;
}

namespace {

void check(const OnlineOptions& options) {
  if (options.cycles < 1 || options.frozen_every < 0) {
    throw std::invalid_argument("cycles must be at least 1 and frozen_every at least 0, got " +
                                std::to_string(options.cycles) + " and " + std::to_string(options.frozen_every));
  }
}

bool frozen_due(const OnlineOptions& options, int done) {
  return done == options.cycles || (options.frozen_every > 0 && done % options.frozen_every == 0);
}

void keep_frozen(OnlineHistory& history, int done, double mse) {
  history.frozen_after.push_back(done);
  history.mse_frozen.push_back(mse);
}

template <std::size_t N>
std::vector<double> as_vector(const std::array<double, N>& a) {
  return {a.begin(), a.end()};
}

void reserve(OnlineHistory& history, int cycles) {
  const auto n = static_cast<std::size_t>(cycles);
  history.mse_learning.reserve(n);
  history.parameters.reserve(n);
  history.rates.reserve(n);
}

OnlineStatus judge(bool still, double mse_frozen, double mean_square) {
  return still && mse_frozen > 1e-12 * mean_square ? OnlineStatus::stalled : OnlineStatus::completed;
}

Vector parameters(const StructuredRun& run) {
  Vector theta(StructuredNetwork::linear + 4 * run.wavelets());
  run.save(theta);
  return theta;
}
Vector parameters(const RecurrentRun& run) { return run.theta(); }

bool same_bits(const Vector& a, const Vector& b) {
  return std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.size()) * sizeof(double)) == 0;
}

/// The cycles of a run. A cycle that ends, bit for bit, with the parameters and the memory of the rule that it began
/// with would be repeated by every later one, so that those are not run.
template <class Rates>
class Cycles {
 public:
  explicit Cycles(Rates& rates) : rates_(rates) {}

  /// The sum of squared errors of the next cycle.
  template <class Run, class Signals>
  double train(Run& run, const Signals& signals) {
    if (repeats_) {
      rates_.report.count_again(before_, after_);
      return squares_;
    }
    const Vector theta = parameters(run);
    const std::vector<double> memory = rates_.memory();
    before_ = rates_.report;
    squares_ = rates_.train(run, signals);
    after_ = rates_.report;
    repeats_ = same_bits(theta, parameters(run)) && rates_.memory() == memory;
    return squares_;
  }

 private:
  Rates& rates_;
  RateReport before_, after_;
  double squares_ = 0.0;
  bool repeats_ = false;
};

PlantGain gain_of(const Eigen::Matrix2d& a) { return plant_gain(a(0, 0), a(0, 1), a(1, 0), a(1, 1)); }

}  // namespace

OnlineStatus judge(const StructuredNetwork& network, bool still, double mse_frozen, double mean_square) {
  return gain_of(network.plant()).spectral_radius >= 1.0 ? OnlineStatus::unstable
                                                         : judge(still, mse_frozen, mean_square);
}

StructuredTraining train(const StructuredNetwork& network, const StructuredSignals& signals, StructuredRates& rates,
                         const StructuredMask& learn, const OnlineOptions& options) {
  check(signals);
  check(options);
  StructuredTraining out{network, {}};
  OnlineHistory& history = out.history;
  reserve(history, options.cycles);
  StructuredRun run(network);
  run.want(learn[kV4] || learn[kV5], learn[kWeight] || learn[kTranslation] || learn[kDilation] || learn[kFeedback]);
  run.follow(false);
  rates.prepare(run, signals);
  run.follow(options.follow_state);
  const double samples = static_cast<double>(signals.samples());
  const double mean_square = signals.speed.squaredNorm() / samples;
  keep_frozen(history, 0, mean_squared_error(network, signals));
  OnlineWatch watcher(history, mean_square, history.mse_frozen[0]);
  Vector theta = network.theta();
  Cycles<StructuredRates> cycles(rates);
  bool still = false;
  for (int done = 1; done <= options.cycles; ++done) {
    const double mse = cycles.train(run, signals) / samples;
    run.save(theta);
    if (watcher.diverged(mse, theta)) {
      break;
    }
    still = stands_still(out.network.theta(), theta);
    out.network = StructuredNetwork(theta, network.wavelet());
    history.parameters.emplace_back(theta.data(), theta.data() + StructuredNetwork::linear);
    history.rates.push_back(as_vector(rates.rates()));
    const PlantGain gain = gain_of(out.network.plant());
    rates.report.include(gain.spectral_radius, gain.condition);
    if (frozen_due(options, done)) {
      keep_frozen(history, done, mean_squared_error(out.network, signals));
    }
  }
  history.report = rates.report;
  history.bounds = as_vector(rates.bounds());
  if (history.status == OnlineStatus::diverged) {
    keep_frozen(history, static_cast<int>(history.parameters.size()), mean_squared_error(out.network, signals));
  } else {
    history.status = judge(out.network, still, history.mse_frozen.back(), mean_square);
  }
  return out;
}

RecurrentTraining train(const RecurrentNetwork& network, const RecurrentSignals& signals, RecurrentRates& rates,
                        const OnlineOptions& options) {
  check(network, signals);
  check(options);
  RecurrentTraining out{network, {}};
  OnlineHistory& history = out.history;
  reserve(history, options.cycles);
  RecurrentRun run(network);
  rates.prepare(run, signals);
  const double samples = static_cast<double>(signals.samples());
  const double mean_square = signals.output.squaredNorm() / samples;
  keep_frozen(history, 0, mean_squared_error(network, signals));
  OnlineWatch watcher(history, mean_square, history.mse_frozen[0]);
  Cycles<RecurrentRates> cycles(rates);
  bool still = false;
  for (int done = 1; done <= options.cycles; ++done) {
    const double mse = cycles.train(run, signals) / samples;
    if (watcher.diverged(mse, run.theta())) {
      break;
    }
    still = stands_still(out.network.theta(), run.theta());
    out.network = RecurrentNetwork(run.theta(), network.inputs(), network.wavelet());
    history.rates.push_back(as_vector(rates.rates()));
    if (frozen_due(options, done)) {
      keep_frozen(history, done, mean_squared_error(out.network, signals));
    }
  }
  history.report = rates.report;
  history.bounds = as_vector(rates.bounds());
  if (history.status == OnlineStatus::diverged) {
    keep_frozen(history, static_cast<int>(history.rates.size()), mean_squared_error(out.network, signals));
  } else {
    history.status = judge(still, history.mse_frozen.back(), mean_square);
  }
  return out;
}

}  // namespace rwn
