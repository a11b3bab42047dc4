#include "rwn/networks/rates/thesis.hpp"

#include <algorithm>
#include <cmath>

namespace rwn {
namespace {

/// The constants of the printed bounds are 1, whatever the wavelet (3.44, 3.52); corrected ones are the wavelet's own.
struct WaveletBounds {
  double phi = 1.0, slope = 1.0, scaled_slope = 0.0;
  WaveletBounds(const Wavelet& wavelet, bool printed) {
    if (!printed) {
      phi = wavelet.max_value();
      slope = wavelet.max_derivative();
      scaled_slope = wavelet.max_scaled_derivative();
    }
  }
};

template <std::size_t N>
double numerator(const ThesisRates& rule, const std::array<bool, N>& learn) {
  return 2.0 * rule.fraction / (rule.shared ? std::max(count(learn), 1) : 1);
}

class ThesisStructured : public StructuredRates {
 public:
  ThesisStructured(const ThesisRates& rule, const StructuredNetwork& network, const StructuredMask& learn)
      : rule_(rule), learn_(learn) {
    const WaveletBounds w(network.wavelet(), rule.printed);
    t_.phi = w.phi;
    t_.slope = w.slope;
    t_.scaled_slope = w.scaled_slope;
    t_.printed = rule.printed;
    t_.root_wavelets = std::sqrt(static_cast<double>(network.wavelets()));
    if (rule.maxima == Maxima::running) {
      learn_now();
    }
  }

  /// A cycle of training with all rates zero sees the maxima and moves nothing.
  void prepare(StructuredRun& run, const StructuredSignals& signals) override {
    if (rule_.maxima == Maxima::running) {
      return;
    }
    run.train_thesis(signals, t_);
    record(signals);
    learn_now();
  }

  double train(StructuredRun& run, const StructuredSignals& signals) override {
    if (rule_.maxima == Maxima::pre_pass) {
      return run.train(signals, t_.rate);
    }
    const double squares = run.train_thesis(signals, t_);
    record(signals);
    return squares;
  }

  StructuredRateValues rates() const override { return values(t_.rate); }
  StructuredRateValues bounds() const override { return values(t_.maximum); }

 private:
  static StructuredRateValues values(const double* from) {
    StructuredRateValues out;
    std::copy_n(from, out.size(), out.begin());
    return out;
  }
  void learn_now() {
    for (std::size_t g = 0; g < learn_.size(); ++g) {
      t_.numerator[g] = learn_[g] ? numerator(rule_, learn_) : 0.0;
      t_.rate[g] = t_.maximum[g] > 0.0 ? t_.numerator[g] / (t_.maximum[g] * t_.maximum[g]) : 0.0;
    }
  }
  void record(const StructuredSignals& signals) {
    report.samples += static_cast<long>(signals.samples() - 1);
    report.spectral_radius = t_.spectral_radius;
    report.condition = std::max(1.0, t_.condition);
    report.recurrence = t_.recurrence;
    report.smallest_dilation = 1.0 / t_.steepest;
    report.unstable = t_.unstable;
    report.defective = t_.defective;
    report.recurrent = t_.recurrent;
  }

  ThesisRates rule_;
  StructuredMask learn_;
  ThesisBounds t_{};
};

class ThesisRecurrent : public RecurrentRates {
 public:
  ThesisRecurrent(const ThesisRates& rule, const RecurrentNetwork& network, const RecurrentMask& learn)
      : rule_(rule), wavelet_(network.wavelet(), rule.printed), learn_(learn),
        x_(static_cast<std::size_t>(network.inputs())) {
    const double inputs = static_cast<double>(network.inputs());
    root_inputs_ = std::sqrt(inputs);
    root_wavelets_ = std::sqrt(static_cast<double>(network.wavelets()));
    others_ = std::pow(wavelet_.phi, inputs - 1.0);
  }

  void prepare(RecurrentRun& run, const RecurrentSignals& signals) override {
    if (rule_.maxima == Maxima::running) {
      return;
    }
    run.restart();
    for (Eigen::Index n = 0; n < signals.samples(); ++n) {
      run.advance(signals.inputs.row(n).data());
      see(run, signals.inputs.row(n).data());
    }
    held_ = rule_.maxima == Maxima::pre_pass;
    set_rates();
  }

  const double* rates(const RecurrentRun& run, const double* x) override {
    if (!held_) {
      const bool meaningful = see(run, x);
      set_rates();
      if (!meaningful) {
        std::fill_n(rates_.begin() + kShift, 3, 0.0);
      }
    }
    return rates_.data();
  }
  RecurrentRateValues bounds() const override { return bounds_; }

 private:
  /// Raises the maxima (3.33, 3.38, 3.44, 3.57, 3.75, 3.88); false where |c/d| max|phi'| >= 1 leaves them without meaning.
  bool see(const RecurrentRun& run, const double* x) {
    ++report.samples;
    watch(report, run, wavelet_.slope);
    double largest_input = 0.0;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      x_[i] = std::max(x_[i], std::abs(x[i]));
      largest_input = std::max(largest_input, x_[i]);
    }
    raise(kBias, 1.0);
    raise(kDirect, root_inputs_ * largest_input);
    raise(kOutput, root_wavelets_ * others_ * wavelet_.phi);
    return see_wavelets(run);
  }

  bool see_wavelets(const RecurrentRun& run) {
    const auto w = run.parameters(kOutput);
    const auto m = run.parameters(kShift), d = run.parameters(kScale), c = run.parameters(kLoop);
    const Eigen::Index inputs = run.network().inputs();
    double translation = 0.0, dilation = 0.0;
    for (Eigen::Index k = 0; k < d.size(); ++k) {
      const double steep = 1.0 / std::abs(d[k]);
      const double ratio = wavelet_.slope * std::abs(c[k]) * steep;
      if (!(ratio < 1.0)) {
        return false;
      }
      const double driven = others_ * std::abs(w[k / inputs]) * steep / (1.0 - ratio);
      const double x = x_[static_cast<std::size_t>(k % inputs)];
      const double reach = rule_.printed ? (x + std::abs(c[k]) + std::abs(m[k])) * steep : wavelet_.scaled_slope;
      translation = std::max(translation, driven * wavelet_.slope);
      dilation = std::max(dilation, driven * reach);
    }
    const double root = root_wavelets_ * root_inputs_;
    raise(kShift, root * translation);
    raise(kScale, root * dilation);
    raise(kLoop, root * translation * wavelet_.phi);
    return true;
  }

  void raise(std::size_t g, double bound) { bounds_[g] = std::max(bounds_[g], bound); }
  void set_rates() {
    const double top = numerator(rule_, learn_);
    for (std::size_t g = 0; g < bounds_.size(); ++g) {
      rates_[g] = learn_[g] && bounds_[g] > 0.0 ? top / (bounds_[g] * bounds_[g]) : 0.0;
    }
  }

  ThesisRates rule_;
  WaveletBounds wavelet_;
  RecurrentMask learn_;
  std::vector<double> x_;
  double root_inputs_ = 1.0, root_wavelets_ = 1.0, others_ = 1.0;
  bool held_ = false;
  RecurrentRateValues bounds_{}, rates_{};
};

}  // namespace

std::unique_ptr<StructuredRates> ThesisRates::on(const StructuredNetwork& network, const StructuredMask& learn) const {
  return std::make_unique<ThesisStructured>(*this, network, learn);
}

std::unique_ptr<RecurrentRates> ThesisRates::on(const RecurrentNetwork& network, const RecurrentMask& learn) const {
  return std::make_unique<ThesisRecurrent>(*this, network, learn);
}

}  // namespace rwn
