#include "rwn/networks/rates/thesis.hpp"

#include <algorithm>
#include <cmath>

#include "rwn/networks/plant_analysis.hpp"
#include "rwn/networks/rates/tightened.hpp"

namespace rwn {
namespace {

/// What `thesis` and `tightened` differ in, and share.
struct Options {
  double fraction;
  Maxima maxima;
  bool shared, printed, misprint, eigen;
  explicit Options(const ThesisRates& r)
      : fraction(r.fraction), maxima(r.maxima), shared(r.shared), printed(true), misprint(r.misprint), eigen(r.eigen) {}
  explicit Options(const TightenedRates& r)
      : fraction(r.fraction), maxima(r.maxima), shared(r.shared), printed(false), misprint(false), eigen(r.eigen) {}
};

/// The constants of the printed bounds are 1, whatever the wavelet (3.44, 3.52); tightened ones are the wavelet's own.
template <class Bounds>
void set_constants(Bounds& t, const Wavelet& wavelet, bool printed) {
  t.printed = printed;
  t.phi = printed ? 1.0 : wavelet.max_value();
  t.slope = printed ? 1.0 : wavelet.max_derivative();
  t.scaled_slope = printed ? 0.0 : wavelet.max_scaled_derivative();
}

/// The rates of the groups that learn, from the maxima as they stand.
template <class Bounds, std::size_t N>
void set_rates(Bounds& t, const Options& rule, const std::array<bool, N>& learn) {
  const double numerator = 2.0 * rule.fraction / (rule.shared ? std::max(count(learn), 1) : 1);
  for (std::size_t g = 0; g < N; ++g) {
    t.numerator[g] = learn[g] ? numerator : 0.0;
    t.rate[g] = t.maximum[g] > 0.0 ? t.numerator[g] / (t.maximum[g] * t.maximum[g]) : 0.0;
  }
}

template <std::size_t N>
std::array<double, N> values(const double (&from)[N]) {
  std::array<double, N> out;
  std::copy_n(from, N, out.begin());
  return out;
}

PlantGain by_eigen(double a11, double a12, double a21, double a22) {
  return plant_gain_by_eigen(Eigen::Matrix2d{{a11, a12}, {a21, a22}});
}

/// Maxima, rates and reports of the rule on one kind of network.
template <class Rates, class Bounds, std::size_t N>
class Adaptive : public Rates {
 public:
  using Values = std::array<double, N>;
  Adaptive(const Options& rule, const Wavelet& wavelet, const std::array<bool, N>& learn) : rule_(rule), learn_(learn) {
    set_constants(t_, wavelet, rule.printed);
    if (rule.maxima == Maxima::running) {
      set_rates(t_, rule_, learn_);
    }
  }
  Values rates() const override { return values(t_.rate); }
  Values bounds() const override { return values(t_.maximum); }

 protected:
  /// The maxima and rates of the groups, to which a network adds those of its signals.
  std::vector<double> remembered() const {
    std::vector<double> all(t_.maximum, t_.maximum + N);
    all.insert(all.end(), t_.rate, t_.rate + N);
    return all;
  }

  Options rule_;
  std::array<bool, N> learn_;
  Bounds t_{};
};

class AdaptiveStructured : public Adaptive<StructuredRates, ThesisBounds, kStructuredGroups> {
 public:
  AdaptiveStructured(const Options& rule, const StructuredNetwork& network, const StructuredMask& learn)
      : Adaptive(rule, network.wavelet(), learn) {
    t_.misprint = rule.misprint;
    t_.decompose = rule.eigen ? by_eigen : nullptr;
    t_.root_wavelets = std::sqrt(static_cast<double>(network.wavelets()));
  }

  /// A cycle of training with all rates zero sees the maxima and moves nothing.
  void prepare(StructuredRun& run, const StructuredSignals& signals) override {
    if (rule_.maxima == Maxima::running) {
      return;
    }
    run.train_thesis(signals, t_);
    record(signals);
    set_rates(t_, rule_, learn_);
  }

  double train(StructuredRun& run, const StructuredSignals& signals) override {
    if (rule_.maxima == Maxima::pre_pass) {
      return run.train(signals, t_.rate);
    }
    const double squares = run.train_thesis(signals, t_);
    record(signals);
    return squares;
  }

  std::vector<double> memory() const override {
    std::vector<double> all = remembered();
    all.insert(all.end(), {t_.x1, t_.x2, t_.u, t_.tau, t_.input});
    return all;
  }

 private:
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
};

class AdaptiveRecurrent : public Adaptive<RecurrentRates, RecurrentBounds, kRecurrentGroups> {
 public:
  AdaptiveRecurrent(const Options& rule, const RecurrentNetwork& network, const RecurrentMask& learn)
      : Adaptive(rule, network.wavelet(), learn), input_(static_cast<std::size_t>(network.inputs())) {
    const double inputs = static_cast<double>(network.inputs());
    t_.input = input_.data();
    t_.root_inputs = std::sqrt(inputs);
    t_.root_wavelets = std::sqrt(static_cast<double>(network.wavelets()));
    t_.others = std::pow(t_.phi, inputs - 1.0);
  }

  void prepare(RecurrentRun& run, const RecurrentSignals& signals) override {
    if (rule_.maxima == Maxima::running) {
      return;
    }
    run.train_thesis(signals, t_);
    record();
    set_rates(t_, rule_, learn_);
  }

  double train(RecurrentRun& run, const RecurrentSignals& signals) override {
    if (rule_.maxima == Maxima::pre_pass) {
      return run.train(signals, t_.rate);
    }
    const double squares = run.train_thesis(signals, t_);
    record();
    return squares;
  }

  std::vector<double> memory() const override {
    std::vector<double> all = remembered();
    all.insert(all.end(), input_.begin(), input_.end());
    return all;
  }

 private:
  void record() {
    report.samples = t_.samples;
    report.recurrence = t_.recurrence;
    report.smallest_dilation = 1.0 / t_.steepest;
    report.recurrent = t_.recurrent;
  }

  std::vector<double> input_;
};

}  // namespace

std::unique_ptr<StructuredRates> ThesisRates::on(const StructuredNetwork& network, const StructuredMask& learn) const {
  return std::make_unique<AdaptiveStructured>(Options(*this), network, learn);
}

std::unique_ptr<RecurrentRates> ThesisRates::on(const RecurrentNetwork& network, const RecurrentMask& learn) const {
  return std::make_unique<AdaptiveRecurrent>(Options(*this), network, learn);
}

std::unique_ptr<StructuredRates> TightenedRates::on(const StructuredNetwork& network,
                                                    const StructuredMask& learn) const {
  return std::make_unique<AdaptiveStructured>(Options(*this), network, learn);
}

std::unique_ptr<RecurrentRates> TightenedRates::on(const RecurrentNetwork& network, const RecurrentMask& learn) const {
  return std::make_unique<AdaptiveRecurrent>(Options(*this), network, learn);
}

}  // namespace rwn
