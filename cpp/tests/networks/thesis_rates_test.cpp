// The bounds of the `thesis` and `tightened` rules against their equations, written out by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "allocations.hpp"
#include "rwn/networks/plant_analysis.hpp"
#include "rwn/networks/rates.hpp"
#include "structured_fixture.hpp"

namespace rwn {
namespace {

using testing::network;
using testing::Recording;

constexpr double kTiny = 1e-100;  // a fraction that moves nothing
const StructuredMask kAll{true, true, true, true, true, true, true, true, true};
const RecurrentMask kEvery{true, true, true, true, true, true};

struct Constants {
  double phi, slope, scaled;
  bool printed;
};
Constants printed() { return {1.0, 1.0, 0.0, true}; }
Constants own(const Wavelet& w) { return {w.max_value(), w.max_derivative(), w.max_scaled_derivative(), false}; }

/// Largest |x1|, |x2|, |u|, |tau| and |measured speed| that the samples of a cycle are driven by.
struct Largest {
  double x1 = 0, x2 = 0, u = 0, tau = 0, speed = 0;
  Largest(const StructuredNetwork& net, const StructuredSignals& s) {
    StructuredRun run(net);
    run.restart(s.start);
    const auto raise = [](double& m, double v) { m = std::max(m, std::abs(v)); };
    for (Eigen::Index n = 1; n < s.samples(); ++n) {
      raise(x1, run.linear(kX1)), raise(x2, run.linear(kX2));
      raise(u, s.input[n - 1]), raise(speed, s.speed[n - 1]);
      run.advance(s.input[n - 1], s.speed[n - 1]);
      raise(tau, run.linear(kTau));
    }
  }
};

/// Bounds of (4.51), (4.63), (4.75), (E.11), (E.23), (4.87), (4.99), (4.111), (4.123).
StructuredRateValues by_hand(const StructuredNetwork& net, const StructuredSignals& s, const Constants& k,
                             bool misprint) {
  const Largest x(net, s);
  const Vector v = net.theta().head(5).cwiseAbs();
  const PlantGain plant = plant_gain_by_eigen(net.plant());
  const double gain = plant.condition / (1.0 - plant.spectral_radius);
  double translation = 0.0, dilation = 0.0;
  for (Eigen::Index j = 0; j < net.wavelets(); ++j) {
    const double w = std::abs(net.group(kWeight)[j]), m = std::abs(net.group(kTranslation)[j]);
    const double d = std::abs(net.group(kDilation)[j]), c = std::abs(net.group(kFeedback)[j]);
    const double driven = w / d / (1.0 - k.slope * c / d);
    translation = std::max(translation, driven * k.slope);
    dilation = std::max(dilation, driven * (k.printed ? (x.speed + c + m) / d : k.scaled));
  }
  const double net_gain = gain * v[1] * std::sqrt(static_cast<double>(net.wavelets()));
  return {gain * v[1] * x.x1,
          gain * (v[2] * x.x2 + v[0] * x.x1 + x.tau),
          gain * ((misprint ? v[2] : v[1]) * x.x2 + v[3] * x.x1),
          gain * (v[2] * x.x1 + x.u),
          gain * x.x2,
          net_gain * k.phi,
          net_gain * translation,
          net_gain * dilation,
          net_gain * translation * k.phi};
}

/// With running maxima the kernel itself makes the rates of a bound; it returns the sum of squared errors.
template <class Run, class Rule, class Network, class Signals, class Mask, class Values>
void expect_running(Rule rule, const Network& net, const Signals& signals, const Mask& learn, const Values& wanted,
                    double squares) {
  rule.maxima = Maxima::running;
  Run run(net);
  const auto rates = rule.on(net, learn);
  EXPECT_NEAR(rates->train(run, signals) / squares, 1.0, 1e-12);
  for (std::size_t g = 0; g < wanted.size(); ++g) {
    EXPECT_NEAR(rates->bounds()[g] / wanted[g], 1.0, 1e-11) << "group " << g;
    EXPECT_NEAR(rates->rates()[g] * wanted[g] * wanted[g] / (2.0 * kTiny), 1.0, 1e-10) << "group " << g;
  }
}

template <class Rule>
void expect_structured(const Rule& rule, const StructuredNetwork& net, const Constants& k, bool misprint = false) {
  const Recording r(900);
  const auto rates = rule.on(net, kAll);
  StructuredRun run(net);
  rates->prepare(run, r.signals());
  const StructuredRateValues wanted = by_hand(net, r.signals(), k, misprint);
  for (std::size_t g = 0; g < wanted.size(); ++g) {
    EXPECT_NEAR(rates->bounds()[g] / wanted[g], 1.0, 1e-11) << "group " << g;
    EXPECT_NEAR(rates->rates()[g] * wanted[g] * wanted[g] / (2.0 * kTiny), 1.0, 1e-10) << "group " << g;
  }
  const double squares = (r.speed - simulate(net, r.signals())).squaredNorm();
  expect_running<StructuredRun>(rule, net, r.signals(), kAll, wanted, squares);
}

TEST(ThesisRates, BoundsOfTheStructuredNetwork) {
  for (const char* name : {"gaussian-derivative", "mexican-hat"}) {
    for (Eigen::Index wavelets : {7, 15, 16}) {
      const StructuredNetwork net = network(wavelets, 3, Wavelet(name));
      expect_structured(ThesisRates{kTiny, Maxima::pre_pass, false}, net, printed());
      expect_structured(ThesisRates{kTiny, Maxima::pre_pass, false, true}, net, printed(), true);
      expect_structured(ThesisRates{kTiny, Maxima::pre_pass, false, false, true}, net, printed());
      expect_structured(TightenedRates{kTiny, Maxima::pre_pass, false}, net, own(net.wavelet()));
    }
  }
}

RecurrentNetwork recurrent(Eigen::Index inputs, Eigen::Index wavelets, const Wavelet& wavelet) {
  Vector theta(1 + inputs + wavelets * (1 + 3 * inputs));
  for (Eigen::Index k = 0; k < theta.size(); ++k) {
    theta[k] = std::sin(1.7 * static_cast<double>(k + 1));
  }
  const Eigen::Index n = wavelets * inputs;
  theta.segment(theta.size() - 2 * n, n).array() += 2.5;
  theta.tail(n) *= 0.2 / wavelet.max_derivative();
  return {theta, inputs, wavelet};
}

/// Bounds of (3.33), (3.38), (3.44), (3.57), (3.75), (3.88) at the largest inputs.
RecurrentRateValues by_hand(const RecurrentNetwork& net, const RowMatrix& x, const Constants& k) {
  const RecurrentRun run(net);
  const Vector largest = x.cwiseAbs().colwise().maxCoeff();
  const double inputs = static_cast<double>(net.inputs()), wavelets = static_cast<double>(net.wavelets());
  const double others = std::pow(k.phi, inputs - 1.0);
  double translation = 0.0, dilation = 0.0;
  for (Eigen::Index e = 0; e < net.size(kScale); ++e) {
    const double w = std::abs(run.parameters(kOutput)[e / net.inputs()]), m = std::abs(run.parameters(kShift)[e]);
    const double d = std::abs(run.parameters(kScale)[e]), c = std::abs(run.parameters(kLoop)[e]);
    const double driven = others * w / d / (1.0 - k.slope * c / d);
    translation = std::max(translation, driven * k.slope);
    dilation = std::max(dilation, driven * (k.printed ? (largest[e % net.inputs()] + c + m) / d : k.scaled));
  }
  const double root = std::sqrt(inputs * wavelets);
  return {1.0, std::sqrt(inputs) * largest.maxCoeff(), std::sqrt(wavelets) * others * k.phi,
          root * translation, root * dilation, root * translation * k.phi};
}

template <class Rule>
void expect_recurrent(const Rule& rule, const RecurrentNetwork& net, const Constants& k) {
  RowMatrix x(400, net.inputs());
  for (Eigen::Index n = 0; n < x.rows(); ++n) {
    for (Eigen::Index i = 0; i < net.inputs(); ++i) {
      x(n, i) = (0.5 + static_cast<double>(i)) * std::sin(0.02 * static_cast<double>((n + 1) * (i + 1)));
    }
  }
  const Vector y = Vector::Ones(x.rows());
  const auto rates = rule.on(net, kEvery);
  RecurrentRun run(net);
  rates->prepare(run, {x, y});
  const RecurrentRateValues wanted = by_hand(net, x, k);
  for (std::size_t g = 0; g < wanted.size(); ++g) {
    EXPECT_NEAR(rates->bounds()[g] / wanted[g], 1.0, 1e-12) << "group " << g << " of " << net.inputs() << " inputs";
    EXPECT_NEAR(rates->rates()[g] * wanted[g] * wanted[g] / (2.0 * kTiny), 1.0, 1e-11) << "group " << g;
  }
  const double squares = (y - simulate(net, x)).squaredNorm();
  expect_running<RecurrentRun>(rule, net, RecurrentSignals{x, y}, kEvery, wanted, squares);
}

TEST(ThesisRates, BoundsOfTheRecurrentNetwork) {
  for (const char* name : {"gaussian-derivative", "mexican-hat"}) {
    for (Eigen::Index inputs : {1, 2, 5}) {
      for (Eigen::Index wavelets : {3, 8, 15}) {
        const RecurrentNetwork net = recurrent(inputs, wavelets, Wavelet(name));
        expect_recurrent(ThesisRates{kTiny, Maxima::pre_pass, false}, net, printed());
        expect_recurrent(TightenedRates{kTiny, Maxima::pre_pass, false}, net, own(net.wavelet()));
      }
    }
  }
}

/// Parameters with c of every wavelet at a ratio of its d; the last 2 n are d and c.
Vector at_recurrence(Vector theta, Eigen::Index n, double ratio) {
  theta.tail(n) = ratio * theta.segment(theta.size() - 2 * n, n);
  return theta;
}

TEST(ThesisRates, TheBoundsEndWhereTheRecurrenceReachesOne) {
  const Recording r(200);
  const Vector y = Vector::Ones(200);
  for (double ratio : {0.7, 1.3}) {
    const StructuredNetwork structured(at_recurrence(network(15, 1).theta(), 15, ratio), Wavelet());
    StructuredRun run(structured);
    const auto rates = ThesisRates{1e-9}.on(structured, kAll);
    rates->train(run, r.signals());
    Vector after = structured.theta();
    run.save(after);
    EXPECT_EQ((after - structured.theta()).norm() > 0.0, ratio < 1.0);
    EXPECT_EQ(rates->report.recurrent, ratio < 1.0 ? 0 : 199);

    const RecurrentNetwork net(at_recurrence(recurrent(1, 15, Wavelet()).theta(), 15, ratio), 1, Wavelet());
    RecurrentRun loop(net);
    const auto looped = ThesisRates{1e-9}.on(net, kEvery);
    looped->train(loop, {r.speed, y});
    const Vector learned = loop.theta();
    EXPECT_EQ((learned - net.theta()).tail(45).norm() > 0.0, ratio < 1.0);
    EXPECT_GT((learned - net.theta()).head(17).norm(), 0.0);
    EXPECT_EQ(looped->report.recurrent, ratio < 1.0 ? 0 : 200);
  }
}

/// A motor with v1 .. v5 as given and 7 wavelets, learning at every sample of a short recording.
struct Learned {
  RateReport report;
  double moved;
  explicit Learned(const Vector& v) : moved(0.0) {
    Vector theta = network(7, 1).theta();
    theta.head(5) = v;
    const StructuredNetwork net(theta, Wavelet());
    const Recording r(50);
    StructuredRun run(net);
    const auto rates = ThesisRates{1e-9}.on(net, kAll);
    rates->train(run, r.signals());
    run.save(theta);
    report = rates->report;
    moved = (theta - net.theta()).norm();
  }
};

TEST(ThesisRates, WhatHasNoBoundIsCountedAndNotLearnedFrom) {
  const Learned stable(Vector{{0.06, 0.5, 0.055, 0.125, 0.95}});
  EXPECT_EQ(stable.report.unstable, 0);
  EXPECT_EQ(stable.report.defective, 0);
  EXPECT_GT(stable.moved, 0.0);
  const Learned unstable(Vector{{0.06, 0.5, 0.055, 0.125, 1.5}});  // rho(A) between 1 and 2
  EXPECT_EQ(unstable.report.unstable, 49);
  EXPECT_EQ(unstable.moved, 0.0);
  const Learned defective(Vector{{0.125, 1.0, 0.5, 0.0625, 0.625}});  // the eigenvalues meet, in exact numbers
  EXPECT_EQ(defective.report.defective, 49);
  EXPECT_EQ(defective.moved, 0.0);
}

TEST(ThesisRates, TheFractionIsSharedAmongTheGroupsThatLearn) {
  const StructuredNetwork net = network(7, 3);
  const Recording r(300);
  const StructuredMask two{false, true, false, false, false, true, false, false, false};
  StructuredRun run(net);
  const auto alone = ThesisRates{0.5, Maxima::pre_pass, false}.on(net, two);
  const auto shared = ThesisRates{0.5, Maxima::pre_pass, true}.on(net, two);
  alone->prepare(run, r.signals());
  shared->prepare(run, r.signals());
  EXPECT_DOUBLE_EQ(alone->rates()[kV2], 2.0 * shared->rates()[kV2]);
  EXPECT_DOUBLE_EQ(alone->rates()[kV2], 1.0 / std::pow(alone->bounds()[kV2], 2));
  EXPECT_EQ(alone->rates()[kV1], 0.0);
}

TEST(ThesisRates, EigensDecompositionLearnsTheSameAndDoesNotAllocate) {
  const StructuredNetwork net = network(15, 1);
  const Recording r(800);
  Vector theta[2] = {net.theta(), net.theta()};
  for (bool eigen : {false, true}) {
    StructuredRun run(net);
    const auto rates = ThesisRates{1e-2, Maxima::running, true, false, eigen}.on(net, kAll);
    const long before = testing::allocations();
    rates->train(run, r.signals());
    EXPECT_EQ(testing::allocations(), before);
    run.save(theta[eigen]);
  }
  EXPECT_GT((theta[0] - net.theta()).norm(), 1e-6);
  EXPECT_LT((theta[0] - theta[1]).norm(), 1e-10 * (theta[0] - net.theta()).norm());
}

TEST(ThesisRates, TheReportIsOfTheWaveletsAndNotOfThePadding) {
  const Recording r(50);
  for (Eigen::Index wavelets : {1, 8, 15}) {
    Vector theta = network(wavelets, 1).theta();
    theta.segment(StructuredNetwork::linear + 2 * wavelets, wavelets).setConstant(5.0);
    theta.tail(wavelets).setConstant(1.0);
    const StructuredNetwork net(theta, Wavelet());
    StructuredRun run(net);
    const auto rates = ThesisRates{1e-9}.on(net, kAll);
    rates->train(run, r.signals());
    EXPECT_NEAR(rates->report.smallest_dilation, 5.0, 1e-6);
    EXPECT_NEAR(rates->report.recurrence, 0.2, 1e-6);
    const PlantGain plant = plant_gain_by_eigen(net.plant());
    EXPECT_NEAR(rates->report.condition / plant.condition, 1.0, 1e-3);
    EXPECT_NEAR(rates->report.spectral_radius / plant.spectral_radius, 1.0, 1e-3);
  }
}

}  // namespace
}  // namespace rwn
