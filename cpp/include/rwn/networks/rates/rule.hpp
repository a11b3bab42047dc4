// What every learning-rate rule offers the trainers, and what it reports.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <string_view>
#include <vector>

#include "rwn/networks/recurrent_network.hpp"
#include "rwn/networks/structured_network.hpp"

namespace rwn {

/// Where the maxima of a bound come from.
enum class Maxima { running, pre_pass, pre_pass_then_running };
/// `running`, `pre-pass`, `pre-pass-then-running`.
std::string_view to_string(Maxima maxima);
/// \throws std::invalid_argument for another name.
Maxima maxima_by_name(std::string_view name);

/// What is wrong with a bound, counted and measured rather than hidden; thresholds are those of the kernels.
struct RateReport {
  double spectral_radius = 0.0;  // largest rho(A); the bounds need rho < 1
  double condition = 1.0;        // largest cond(M); infinite where A is defective, huge where eigenvalues nearly meet
  double recurrence = 0.0;       // largest |c/d| max|phi'|; the bounds need it below 1
  double smallest_dilation = std::numeric_limits<double>::infinity();
  long samples = 0;
  long unstable = 0;   // samples with rho(A) >= 1
  long defective = 0;  // samples with cond(M) > 1e8
  long recurrent = 0;  // samples with recurrence >= 1

  void include(double rho, double cond);
  void include_friction(double ratio, double smallest);
  /// Counts what was counted between two reports once more.
  void count_again(const RateReport& before, const RateReport& after);
};

using StructuredRateValues = std::array<double, kStructuredGroups>;
using StructuredMask = std::array<bool, kStructuredGroups>;
using RecurrentRateValues = std::array<double, kRecurrentGroups>;
using RecurrentMask = std::array<bool, kRecurrentGroups>;

/// A rule at work on a structured network.
class StructuredRates {
 public:
  virtual ~StructuredRates() = default;
  /// Before the first cycle, with the parameters frozen.
  virtual void prepare(StructuredRun&, const StructuredSignals&) {}
  /// One cycle of per-sample training (4.19, 4.29) from its first sample; returns the sum of squared errors.
  virtual double train(StructuredRun& run, const StructuredSignals& signals) = 0;
  /// The rates as they stand.
  virtual StructuredRateValues rates() const = 0;
  /// The bounds of ||dy/dtheta_g|| behind the rates; 0 where the rule has none.
  virtual StructuredRateValues bounds() const { return {}; }
  /// What a cycle takes from those before it, besides the parameters; empty for a rule that remembers nothing.
  virtual std::vector<double> memory() const { return {}; }

  RateReport report;
};

/// A rule at work on a recurrent network.
class RecurrentRates {
 public:
  virtual ~RecurrentRates() = default;
  virtual void prepare(RecurrentRun&, const RecurrentSignals&) {}
  /// One cycle of per-sample training (3.19) from its first sample; returns the sum of squared errors.
  virtual double train(RecurrentRun& run, const RecurrentSignals& signals) = 0;
  virtual RecurrentRateValues rates() const = 0;
  virtual RecurrentRateValues bounds() const { return {}; }
  virtual std::vector<double> memory() const { return {}; }

  RateReport report;
};

/// Number of groups that learn.
template <std::size_t N>
int count(const std::array<bool, N>& mask) {
  int n = 0;
  for (bool learns : mask) {
    n += learns;
  }
  return n;
}

/// Largest |c/d| max|phi'| and smallest |d| over a network's wavelets, into the report.
void watch(RateReport& report, const RecurrentRun& run, double slope);
void watch(RateReport& report, const StructuredRun& run, double slope);

}  // namespace rwn
