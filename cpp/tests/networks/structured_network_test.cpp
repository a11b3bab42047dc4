#include "rwn/networks/structured_network.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "allocations.hpp"
#include "rwn/networks/online_training.hpp"
#include "rwn/networks/plant_analysis.hpp"
#include "rwn/networks/rates.hpp"
#include "structured_fixture.hpp"

namespace rwn {
namespace {

using testing::network;
using testing::Recording;

class StructuredWavelets : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Every, StructuredWavelets, ::testing::Values("gaussian-derivative", "mexican-hat", "morlet"));

/// The network along a recording by the scalar wavelet and the equations 3.3, 4.6, 4.10.
Vector by_hand(const StructuredNetwork& net, const StructuredSignals& s) {
  Eigen::Vector2d x = s.start;
  Vector phi = Vector::Zero(net.wavelets()), out(s.samples());
  out[0] = x[0];
  for (Eigen::Index n = 1; n < s.samples(); ++n) {
    double tau = 0.0;
    for (Eigen::Index j = 0; j < net.wavelets(); ++j) {
      const double z =
          (s.speed[n - 1] + net.group(kFeedback)[j] * phi[j] - net.group(kTranslation)[j]) / net.group(kDilation)[j];
      phi[j] = net.wavelet().value(z);
      tau += net.group(kWeight)[j] * phi[j];
    }
    x = net.plant() * x + Eigen::Vector2d(-net.theta()[1] * tau, net.theta()[3] * s.input[n - 1]);
    out[n] = x[0];
  }
  return out;
}

TEST_P(StructuredWavelets, SimulatesItsEquations) {
  const Recording r(2000);
  for (Eigen::Index wavelets : {0, 1, 7, 15, 16, 31}) {
    const StructuredNetwork net = network(wavelets, 3, Wavelet(GetParam()));
    const Vector wanted = by_hand(net, r.signals());
    EXPECT_LT((simulate(net, r.signals()) - wanted).cwiseAbs().maxCoeff(), 1e-12 * wanted.cwiseAbs().maxCoeff());
  }
}

TEST_P(StructuredWavelets, SensitivitiesMatchFiniteDifferences) {
  const Recording r(800);
  const StructuredNetwork net = network(6, 5, Wavelet(GetParam()));
  const StructuredSensitivities s = sensitivities(net, r.signals());
  for (Eigen::Index k = 0; k < net.theta().size(); ++k) {
    Vector plus = net.theta(), minus = net.theta();
    const double step = 1e-6 * std::max(std::abs(net.theta()[k]), k < 5 ? 0.0 : 1e-2);
    plus[k] += step;
    minus[k] -= step;
    const Vector difference =
        (simulate({plus, net.wavelet()}, r.signals()) - simulate({minus, net.wavelet()}, r.signals())) / (2.0 * step);
    EXPECT_LT((s.jacobian.col(k) - difference).cwiseAbs().maxCoeff(), 2e-6 * difference.cwiseAbs().maxCoeff() + 2e-8)
        << k;  // the difference is good to 1e-8
  }
}

TEST(StructuredRun, TrainingSampleBySampleEqualsTheCycleKernel) {
  const Recording r(1500);
  const StructuredNetwork net = network(15, 2);
  const double rates[kStructuredGroups] = {1e-6, 1e-6, 1e-7, 1e-8, 1e-8, 1e-6, 1e-5, 1e-5, 1e-5};
  StructuredRun cycle(net), steps(net);
  cycle.train(r.signals(), rates);
  steps.restart({0.0, 0.0});
  for (Eigen::Index n = 1; n < r.speed.size(); ++n) {
    steps.advance(r.input[n - 1], r.speed[n - 1]);
    steps.correct(rates, r.speed[n] - steps.speed());
  }
  Vector a = net.theta(), b = net.theta();
  cycle.save(a);
  steps.save(b);
  EXPECT_GT((a - net.theta()).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_LT((a - b).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(StructuredRun, TheStateFollowsAStepAsItFollowsAShift) {
  const Recording r(300);
  const StructuredNetwork net = network(15, 2);
  const double rates[kStructuredGroups] = {1e-3, 1e-3, 1e-4, 1e-5, 1e-5, 1e-3, 1e-2, 1e-2, 1e-2};
  StructuredRun step(net), shift(net);
  for (StructuredRun* run : {&step, &shift}) {
    run->follow(true);
    run->restart({0.0, 0.0});
    for (Eigen::Index n = 1; n < r.speed.size(); ++n) {
      run->advance(r.input[n - 1], r.speed[n - 1]);
    }
  }
  Vector change(net.theta().size());
  shift.speed_sensitivity(change.data());
  for (int g = 0; g < kStructuredGroups; ++g) {
    change.segment(net.offset(g), net.size(g)) *= 0.3 * rates[g];
  }
  const double before = step.linear(kX2);
  step.correct(rates, 0.3);
  shift.shift(change);
  EXPECT_GT(std::abs(step.linear(kX2) - before), 1e-9);
  EXPECT_NEAR(step.linear(kX1), shift.linear(kX1), 1e-14);
  EXPECT_NEAR(step.linear(kX2), shift.linear(kX2), 1e-14);
}

TEST(StructuredRun, PerSampleLoopsDoNotAllocate) {
  const Recording r(500);
  const StructuredNetwork net = network(15, 1);
  const StructuredMask all{true, true, true, true, true, true, true, true, true};
  const Vector change = Vector::Zero(net.theta().size());
  StructuredRun run(net);
  for (const auto& rule : std::vector<RateRule>{FixedRates{std::vector<double>(9, 1e-8)}, ThesisRates{1e-3},
                                               ImpulseResponseRates{}, NormalisedRates{1e-3}}) {
    const auto rates = std::visit([&](const auto& v) { return v.on(net, all); }, rule);
    const long before = testing::allocations();
    rates->prepare(run, r.signals());
    rates->train(run, r.signals());
    run.shift(change);
    EXPECT_EQ(testing::allocations(), before) << rule.index();
  }
}

TEST(StructuredNetwork, RefusesBadParameters) {
  EXPECT_THROW(StructuredNetwork(Vector::Ones(7), Wavelet()), std::invalid_argument);
  EXPECT_THROW(StructuredNetwork(Vector::Zero(9), Wavelet()), std::invalid_argument);
}

TEST(PlantGain, ClosedFormEqualsEigen) {
  std::mt19937 rng(0);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int k = 0; k < 2000; ++k) {
    const Eigen::Matrix2d a{{u(rng), u(rng)}, {u(rng), u(rng)}};
    const PlantGain closed = plant_gain(a(0, 0), a(0, 1), a(1, 0), a(1, 1));
    const PlantGain eigen = plant_gain_by_eigen(a);
    EXPECT_NEAR(closed.spectral_radius, eigen.spectral_radius, 1e-12);
    EXPECT_NEAR(closed.condition / eigen.condition, 1.0, 1e-13 * eigen.condition * eigen.condition + 1e-12) << a;
  }
}

TEST(PlantGain, RepeatedEigenvalues) {
  EXPECT_TRUE(std::isinf(plant_gain(0.5, 1.0, 0.0, 0.5).condition));
  EXPECT_EQ(plant_gain(0.5, 0.0, 0.0, 0.5).condition, 1.0);
  EXPECT_NEAR(plant_gain(0.0, 0.9, -0.9, 0.0).condition, 1.0, 1e-15);
}

}  // namespace
}  // namespace rwn
