#include "rwn/networks/rates/normalised.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace rwn {
namespace {

template <std::size_t N>
std::array<double, N> given(const std::vector<double>& scales) {
  if (!scales.empty() && scales.size() != N) {
    throw std::invalid_argument("scales: expected " + std::to_string(N) + " values, one per group, got " +
                                std::to_string(scales.size()));
  }
  std::array<double, N> out{};
  std::copy(scales.begin(), scales.end(), out.begin());
  return out;
}

double median_size(const Eigen::Ref<const Vector>& x) {
  Vector a = x.cwiseAbs();
  std::nth_element(a.begin(), a.begin() + a.size() / 2, a.end());
  return a[a.size() / 2];
}

class NormalisedStructured : public StructuredRates {
 public:
  NormalisedStructured(const NormalisedRates& rule, const StructuredNetwork& network, const StructuredMask& learn)
      : rule_(rule), learn_(learn), slope_(network.wavelet().max_derivative()),
        scale_(given<kStructuredGroups>(rule.scales)) {
    if (rule.scales.empty()) {
      set_scales(network);
    }
    for (std::size_t g = 0; g < scale_.size(); ++g) {
      scale_[g] = learn_[g] ? scale_[g] * scale_[g] : 0.0;
    }
  }

  /// The largest S(n), and the torque that the weights may have to carry.
  void prepare(StructuredRun& run, const StructuredSignals& signals) override {
    double torque = 0.0;
    run.restart(signals.start);
    for (Eigen::Index n = 1; n < signals.samples(); ++n) {
      run.advance(signals.input[n - 1], signals.speed[n - 1]);
      largest_ = std::max(largest_, weigh(run));
      torque = std::max(torque, std::abs(run.linear(kV + 2) * run.linear(kX2)));
    }
    if (rule_.scales.empty() && learn_[kWeight] && run.wavelets() > 0) {
      scale_[kWeight] = torque * torque / static_cast<double>(run.wavelets());
      run.restart(signals.start);
      for (Eigen::Index n = 1; n < signals.samples(); ++n) {
        run.advance(signals.input[n - 1], signals.speed[n - 1]);
        largest_ = std::max(largest_, weigh(run));
      }
    }
  }

  double train(StructuredRun& run, const StructuredSignals& signals) override {
    run.restart(signals.start);
    double squares = std::pow(signals.speed[0] - run.speed(), 2);
    for (Eigen::Index n = 1; n < signals.samples(); ++n) {
      run.advance(signals.input[n - 1], signals.speed[n - 1]);
      const double error = signals.speed[n] - run.speed();
      squares += error * error;
      const double step = rule_.fraction / (rule_.regularisation * largest_ + weigh(run));
      for (std::size_t g = 0; g < rates_.size(); ++g) {
        rates_[g] = std::isfinite(step) ? step * scale_[g] : 0.0;
      }
      run.correct(rates_.data(), error);
    }
    watch(report, run, slope_);
    return squares;
  }

  StructuredRateValues rates() const override { return rates_; }

 private:
  /// Scales from the network: v1..v5 by their size (v1 at least Kt^2/R, the electrical damping), m, d, c by the
  /// dilations.
  void set_scales(const StructuredNetwork& network) {
    const Vector& v = network.theta();
    for (std::size_t g = 0; g < kWeight; ++g) {
      scale_[g] = std::abs(v[static_cast<Eigen::Index>(g)]);
    }
    const double conductance = v[4] < 1.0 ? std::abs(v[3]) / (1.0 - v[4]) : 0.0;
    scale_[kV1] = std::max(scale_[kV1], v[2] * v[2] * conductance);
    scale_[kV5] = std::abs(1.0 - v[4]);
    if (network.wavelets() > 0) {
      const double width = median_size(network.group(kDilation));
      scale_[kWeight] = network.group(kWeight).cwiseAbs().maxCoeff();
      scale_[kTranslation] = scale_[kDilation] = 0.1 * width;
      scale_[kFeedback] = 0.01 * width;
    }
  }

  double weigh(const StructuredRun& run) const {
    double s = 0.0;
    for (std::size_t k = 0; k < kWeight; ++k) {
      const double p = run.linear(kP + static_cast<int>(k));
      s += scale_[k] * p * p;
    }
    for (int g = 0; g < 4; ++g) {
      double squares = 0.0;
      for (Eigen::Index j = 0; j < run.wavelets(); ++j) {
        const double p = run.network(kPNet + g, j);
        squares += p * p;
      }
      s += scale_[static_cast<std::size_t>(kWeight + g)] * squares;
    }
    return s;
  }

  NormalisedRates rule_;
  StructuredMask learn_;
  double slope_;
  StructuredRateValues scale_, rates_{};
  double largest_ = 0.0;
};

class NormalisedRecurrent : public RecurrentRates {
 public:
  NormalisedRecurrent(const NormalisedRates& rule, const RecurrentNetwork& network, const RecurrentMask& learn)
      : rule_(rule), learn_(learn), slope_(network.wavelet().max_derivative()),
        scale_(given<kRecurrentGroups>(rule.scales)) {}

  void prepare(RecurrentRun& run, const RecurrentSignals& signals) override {
    if (rule_.scales.empty()) {
      set_scales(run, signals);
    }
    for (std::size_t g = 0; g < scale_.size(); ++g) {
      scale_[g] = learn_[g] ? scale_[g] * scale_[g] : 0.0;
    }
    run.restart();
    for (Eigen::Index n = 0; n < signals.samples(); ++n) {
      run.advance(signals.inputs.row(n).data());
      largest_ = std::max(largest_, weigh(run));
    }
  }

  double train(RecurrentRun& run, const RecurrentSignals& signals) override {
    run.restart();
    double squares = 0.0;
    for (Eigen::Index n = 0; n < signals.samples(); ++n) {
      const double error = signals.output[n] - run.advance(signals.inputs.row(n).data());
      squares += error * error;
      const double step = rule_.fraction / (rule_.regularisation * largest_ + weigh(run));
      for (std::size_t g = 0; g < rates_.size(); ++g) {
        rates_[g] = std::isfinite(step) ? step * scale_[g] : 0.0;
      }
      watch(report, run, slope_);
      run.correct(rates_.data(), error);
    }
    return squares;
  }
  RecurrentRateValues rates() const override { return rates_; }

 private:
  void set_scales(const RecurrentRun& run, const RecurrentSignals& signals) {
    const double y = signals.output.cwiseAbs().maxCoeff();
    const double x = signals.inputs.cwiseAbs().maxCoeff();
    const double n = std::max<double>(1.0, static_cast<double>(run.network().wavelets()));
    scale_ = {y, x > 0.0 ? y / x : 0.0, y / std::sqrt(n), 0.0, 0.0, 0.0};
    if (run.network().wavelets() > 0) {
      const double width = median_size(run.parameters(kScale));
      scale_[kShift] = scale_[kScale] = 0.1 * width;
      scale_[kLoop] = 0.01 * width;
    }
  }
  double weigh(const RecurrentRun& run) const {
    double s = 0.0;
    for (int g = 0; g < kRecurrentGroups; ++g) {
      s += scale_[static_cast<std::size_t>(g)] * run.sensitivity(g).squaredNorm();
    }
    return s;
  }

  NormalisedRates rule_;
  RecurrentMask learn_;
  double slope_;
  RecurrentRateValues scale_, rates_{};
  double largest_ = 0.0;
};

}  // namespace

std::unique_ptr<StructuredRates> NormalisedRates::on(const StructuredNetwork& network,
                                                     const StructuredMask& learn) const {
  return std::make_unique<NormalisedStructured>(*this, network, learn);
}

std::unique_ptr<RecurrentRates> NormalisedRates::on(const RecurrentNetwork& network, const RecurrentMask& learn) const {
  return std::make_unique<NormalisedRecurrent>(*this, network, learn);
}

}  // namespace rwn
