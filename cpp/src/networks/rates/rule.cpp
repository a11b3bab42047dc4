#include "rwn/networks/rates/rule.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace rwn {
namespace {

constexpr std::array<std::string_view, 3> kMaxima{"running", "pre-pass", "pre-pass-then-running"};  // as in Maxima

}  // namespace

std::string_view to_string(Maxima maxima) { return kMaxima[static_cast<std::size_t>(maxima)]; }

Maxima maxima_by_name(std::string_view name) {
  const auto found = std::find(kMaxima.begin(), kMaxima.end(), name);
  if (found == kMaxima.end()) {
    throw std::invalid_argument("maxima must be running, pre-pass or pre-pass-then-running, got '" + std::string(name) +
                                "'");
  }
  return static_cast<Maxima>(found - kMaxima.begin());
}

void RateReport::include(double rho, double cond) {
  ++samples;
  unstable += !(rho < 1.0);
  defective += !(cond <= kDefectiveCondition);
  spectral_radius = std::max(spectral_radius, rho);
  condition = std::max(condition, cond);
}

void RateReport::include_friction(double ratio, double smallest) {
  recurrent += !(ratio < 1.0);
  recurrence = std::max(recurrence, ratio);
  smallest_dilation = std::min(smallest_dilation, smallest);
}

void RateReport::count_again(const RateReport& before, const RateReport& after) {
  samples += after.samples - before.samples;
  unstable += after.unstable - before.unstable;
  defective += after.defective - before.defective;
  recurrent += after.recurrent - before.recurrent;
}

void watch(RateReport& report, const RecurrentRun& run, double slope) {
  const auto d = run.parameters(kScale).array().abs();
  const auto c = run.parameters(kLoop).array().abs();
  if (d.size() > 0) {
    report.include_friction((c / d).maxCoeff() * slope, d.minCoeff());
  }
}

void watch(RateReport& report, const StructuredRun& run, double slope) {
  double ratio = 0.0;
  double smallest = std::numeric_limits<double>::infinity();
  for (Eigen::Index j = 0; j < run.wavelets(); ++j) {
    const double d = std::abs(run.network(kTheta + 2, j));
    ratio = std::max(ratio, std::abs(run.network(kTheta + 3, j)) / d);
    smallest = std::min(smallest, d);
  }
  if (run.wavelets() > 0) {
    report.include_friction(ratio * slope, smallest);
  }
}

}  // namespace rwn
