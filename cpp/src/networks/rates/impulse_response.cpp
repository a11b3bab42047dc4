#include "rwn/networks/rates/impulse_response.hpp"

#include <algorithm>
#include <cmath>

#include "rwn/networks/plant_analysis.hpp"

namespace rwn {
namespace {

/// Largest drives of the groups' sensitivities over a recording, without the factor |v2| of the network's groups.
struct Drives {
  StructuredRateValues mechanical{}, electrical{};
  double translation = 0.0, dilation = 0.0, feedback = 0.0;  // max_n ||V||, as if every w were 1
  double torque = 0.0;                                       // max |v3 x2|

  void see(const StructuredRun& run, double x1, double x2, double u) {
    const double v1 = run.linear(kV), v2 = run.linear(kV + 1), v3 = run.linear(kV + 2), v4 = run.linear(kV + 3);
    raise(mechanical[kV1], std::abs(v2 * x1));
    raise(mechanical[kV2], std::abs(v3 * x2 - v1 * x1 - run.linear(kTau)));
    raise(mechanical[kV3], std::abs(v2 * x2));
    raise(electrical[kV3], std::abs(v4 * x1));
    raise(electrical[kV4], std::abs(u - v3 * x1));
    raise(electrical[kV5], std::abs(x2));
    raise(torque, std::abs(v3 * x2));
    see_network(run);
  }

  void see_network(const StructuredRun& run) {
    double phi = 0.0, V[3] = {}, weighted[3] = {};
    for (Eigen::Index j = 0; j < run.wavelets(); ++j) {
      const double w = run.network(kTheta, j);
      phi += run.network(kPhi, j) * run.network(kPhi, j);
      for (int k = 0; k < 3; ++k) {
        const double v = run.network(kVee + k, j);
        V[k] += v * v;
        weighted[k] += w * w * v * v;
      }
    }
    raise(mechanical[kWeight], std::sqrt(phi));
    raise(translation, std::sqrt(V[0]));
    raise(dilation, std::sqrt(V[1]));
    raise(feedback, std::sqrt(V[2]));
    raise(mechanical[kTranslation], std::sqrt(weighted[0]));
    raise(mechanical[kDilation], std::sqrt(weighted[1]));
    raise(mechanical[kFeedback], std::sqrt(weighted[2]));
  }

  static void raise(double& maximum, double value) { maximum = std::max(maximum, value); }
};

class ImpulseStructured : public StructuredRates {
 public:
  ImpulseStructured(const ImpulseResponseRates& rule, const StructuredNetwork& network, const StructuredMask& learn)
      : rule_(rule), learn_(learn), plant_(network.plant()), v2_(std::abs(network.theta()[1])),
        slope_(network.wavelet().max_derivative()) {}

  void prepare(StructuredRun& run, const StructuredSignals& signals) override {
    Drives drives;
    run.restart(signals.start);
    for (Eigen::Index n = 1; n < signals.samples(); ++n) {
      const double x1 = run.linear(kX1), x2 = run.linear(kX2);
      run.advance(signals.input[n - 1], signals.speed[n - 1]);
      drives.see(run, x1, x2, signals.input[n - 1]);
    }
    set_bounds(drives, run.wavelets());
    watch(report, run, slope_);
    set_rates();
  }

  double train(StructuredRun& run, const StructuredSignals& signals) override {
    return run.train(signals, rates_.data());
  }
  StructuredRateValues rates() const override { return rates_; }
  StructuredRateValues bounds() const override { return bounds_; }

 private:
  void set_bounds(Drives& d, Eigen::Index wavelets) {
    const ImpulseSums sums = impulse_sums(plant_);
    const double least = wavelets > 0 ? d.torque / std::sqrt(static_cast<double>(wavelets)) : 0.0;
    Drives::raise(d.mechanical[kTranslation], least * d.translation);
    Drives::raise(d.mechanical[kDilation], least * d.dilation);
    Drives::raise(d.mechanical[kFeedback], least * d.feedback);
    for (std::size_t g = 0; g < bounds_.size(); ++g) {
      const double factor = g < kWeight ? 1.0 : v2_;
      bounds_[g] = sums.mechanical * factor * d.mechanical[g];
      if (d.electrical[g] > 0.0) {
        bounds_[g] += sums.electrical * d.electrical[g];
      }
    }
  }

  void set_rates() {
    const PlantGain gain = plant_gain(plant_(0, 0), plant_(0, 1), plant_(1, 0), plant_(1, 1));
    report.include(gain.spectral_radius, gain.condition);
    const double fraction = rule_.fraction > 0.0 ? rule_.fraction : 0.25 * (1.0 - gain.spectral_radius);
    const double top = 2.0 * fraction / (rule_.shared ? std::max(count(learn_), 1) : 1);
    for (std::size_t g = 0; g < bounds_.size(); ++g) {
      const bool meaningful = bounds_[g] > 0.0 && std::isfinite(bounds_[g]);
      rates_[g] = learn_[g] && meaningful ? top / (bounds_[g] * bounds_[g]) : 0.0;
    }
  }

  ImpulseResponseRates rule_;
  StructuredMask learn_;
  Eigen::Matrix2d plant_;
  double v2_, slope_;
  StructuredRateValues bounds_{}, rates_{};
};

/// Without a plant the impulse response is 1 at one sample: the bounds are the largest sensitivities of the pre-pass.
class ImpulseRecurrent : public RecurrentRates {
 public:
  ImpulseRecurrent(const ImpulseResponseRates& rule, const RecurrentNetwork& network, const RecurrentMask& learn)
      : rule_(rule), learn_(learn), slope_(network.wavelet().max_derivative()) {}

  void prepare(RecurrentRun& run, const RecurrentSignals& signals) override {
    run.restart();
    for (Eigen::Index n = 0; n < signals.samples(); ++n) {
      run.advance(signals.inputs.row(n).data());
      for (int g = 0; g < kRecurrentGroups; ++g) {
        double& bound = bounds_[static_cast<std::size_t>(g)];
        bound = std::max(bound, run.sensitivity(g).norm());
      }
    }
    keep_from_zero(run, signals);
    watch(report, run, slope_);
    ++report.samples;
    const double top =
        2.0 * (rule_.fraction > 0.0 ? rule_.fraction : 0.25) / (rule_.shared ? std::max(count(learn_), 1) : 1);
    for (std::size_t g = 0; g < bounds_.size(); ++g) {
      rates_[g] = learn_[g] && bounds_[g] > 0.0 ? top / (bounds_[g] * bounds_[g]) : 0.0;
    }
  }
  double train(RecurrentRun& run, const RecurrentSignals& signals) override {
    return run.train(signals, rates_.data());
  }
  RecurrentRateValues rates() const override { return rates_; }
  RecurrentRateValues bounds() const override { return bounds_; }

 private:
  /// A network with w near 0 will not stay there: its m, d, c are bounded as if w had the size of the output /
  /// sqrt(N_w).
  void keep_from_zero(const RecurrentRun& run, const RecurrentSignals& signals) {
    const auto w = run.parameters(kOutput).array().abs();
    if (w.size() == 0 || w.maxCoeff() == 0.0) {
      return;
    }
    const double least = signals.output.cwiseAbs().maxCoeff() / std::sqrt(static_cast<double>(w.size()));
    for (std::size_t g = kShift; g <= kLoop; ++g) {
      bounds_[g] *= std::max(1.0, least / w.maxCoeff());
    }
  }

  ImpulseResponseRates rule_;
  RecurrentMask learn_;
  double slope_;
  RecurrentRateValues bounds_{}, rates_{};
};

}  // namespace

std::unique_ptr<StructuredRates> ImpulseResponseRates::on(const StructuredNetwork& network,
                                                          const StructuredMask& learn) const {
  return std::make_unique<ImpulseStructured>(*this, network, learn);
}

std::unique_ptr<RecurrentRates> ImpulseResponseRates::on(const RecurrentNetwork& network,
                                                         const RecurrentMask& learn) const {
  return std::make_unique<ImpulseRecurrent>(*this, network, learn);
}

}  // namespace rwn
