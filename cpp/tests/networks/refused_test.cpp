// Networks, recordings and options that cannot be trained with are refused, and options do what they say.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>
#include <vector>

#include "rwn/networks/online_training.hpp"
#include "rwn/networks/rates.hpp"
#include "rwn/networks/recurrent_network.hpp"
#include "rwn/networks/side_by_side.hpp"
#include "rwn/networks/trainers/recursive_gauss_newton.hpp"
#include "rwn/networks/trainers/structured_levenberg_marquardt.hpp"
#include "rwn/networks/conventional_network.hpp"
#include "structured_fixture.hpp"

namespace rwn {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr Eigen::Index samples = 50;

template <class Make>
void expect_refused(const Make& make) {
  EXPECT_THROW(make(), std::invalid_argument);
}

TEST(StructuredNetwork, ParametersThatAreNoneAreRefused) {
  const Vector theta = testing::network(2, 1).theta();
  Vector lost = theta, flat = theta;
  lost[3] = nan;
  flat[5 + 2 * 2] = 0.0;
  for (const Vector& wrong : std::vector<Vector>{theta.head(4), theta.head(7), lost, flat}) {
    expect_refused([&] { StructuredNetwork(wrong, Wavelet()); });
  }
  EXPECT_NO_THROW(StructuredNetwork(theta.head(5), Wavelet()));
}

TEST(StructuredNetwork, RecordingsOfTwoLengthsOrOneSampleAreRefused) {
  const Vector two = Vector::Zero(2), three = Vector::Zero(3), one = Vector::Zero(1);
  expect_refused([&] { simulate(testing::network(1, 1), {two, three}); });
  expect_refused([&] { simulate(testing::network(1, 1), {one, one}); });
  EXPECT_NO_THROW(simulate(testing::network(1, 1), {two, two}));
}

TEST(RecurrentNetwork, ParametersAndInputsThatDoNotFitAreRefused) {
  Vector theta = Vector::Constant(1 + 2 + 7, 0.5);  // two inputs, one wavelet
  EXPECT_NO_THROW(RecurrentNetwork(theta, 2, Wavelet()));
  expect_refused([&] { RecurrentNetwork(theta, 0, Wavelet()); });
  expect_refused([&] { RecurrentNetwork(theta.head(2), 2, Wavelet()); });
  expect_refused([&] { RecurrentNetwork(theta.head(9), 2, Wavelet()); });
  Vector lost = theta, flat = theta;
  lost[0] = nan;
  flat[1 + 2 + 1 + 2] = 0.0;
  expect_refused([&] { RecurrentNetwork(lost, 2, Wavelet()); });
  expect_refused([&] { RecurrentNetwork(flat, 2, Wavelet()); });
  const RecurrentNetwork network(theta, 2, Wavelet());
  const RowMatrix two = RowMatrix::Zero(9, 2), three = RowMatrix::Zero(9, 3), none = RowMatrix::Zero(0, 2);
  const Vector output = Vector::Zero(9), short_output = Vector::Zero(8), nothing = Vector::Zero(0);
  EXPECT_NO_THROW(check(network, {two, output}));
  expect_refused([&] { check(network, {three, output}); });
  expect_refused([&] { check(network, {two, short_output}); });
  expect_refused([&] { check(network, {none, nothing}); });
}

TEST(ConventionalNetwork, ShapesWithoutAnEndAreRefused) {
  const auto make = [](int inputs, int wavelets, int outputs) {
    const ConventionalShape shape{.inputs = inputs, .wavelets = wavelets, .outputs = outputs};
    ConventionalNetwork(Wavelet(), shape, Eigen::VectorXd::Ones(std::max(shape.size(), 0)));
  };
  EXPECT_NO_THROW(make(1, 0, 1));
  expect_refused([&] { make(0, 1, 1); });
  expect_refused([&] { make(1, 1, 0); });
  expect_refused([&] { make(1, -1, 1); });
}

TEST(Wavelet, AFrequencyThatIsNoneIsRefused) {
  expect_refused([] { Wavelet("morlet", 0.0); });
  expect_refused([] { Wavelet("morlet", std::numeric_limits<double>::infinity()); });
  expect_refused([] { Wavelet("haar"); });
}

TEST(RecursiveGaussNewton, OptionsThatNoRecursionRunsWithAreRefused) {
  const testing::Recording r(samples);
  const StructuredNetwork network = testing::network(1, 1);
  const Vector spread = Vector::Constant(9, 0.1);
  const auto train = [&](RecursiveGaussNewton trainer, const Vector& by) {
    return trainer.train(network, r.signals(), by);
  };
  EXPECT_NO_THROW(train({.cycles = 1}, spread));
  for (const RecursiveGaussNewton& wrong : std::vector<RecursiveGaussNewton>{{.noise = 0.0},
                                                                             {.forgetting = 0.0},
                                                                             {.forgetting = 1.1},
                                                                             {.forgetting_decay = -0.1},
                                                                             {.forgetting_decay = 1.1},
                                                                             {.underweighting = -1.0},
                                                                             {.cycles = 0}}) {
    expect_refused([&] { train(wrong, spread); });
  }
  Vector negative = spread, lost = spread;
  negative[2] = -0.1;
  lost[2] = nan;
  for (const Vector& wrong : std::vector<Vector>{spread.head(8), negative, lost, Vector::Zero(9)}) {
    expect_refused([&] { train({}, wrong); });
  }
}

TEST(RecursiveGaussNewton, LearnsWhatHasASpreadAlone) {
  const testing::Recording r(samples);
  const StructuredNetwork network = testing::network(1, 1);
  for (const Eigen::Index one : {0, 3, 4, 6}) {  // v1, v4, v5, a translation
    Vector spread = Vector::Zero(9);
    spread[one] = 0.05;
    const auto fit = RecursiveGaussNewton{.cycles = 4, .frozen_every = 2}.train(network, r.signals(), spread);
    EXPECT_EQ(fit.history.frozen_after, (std::vector<int>{0, 2, 4}));
    for (Eigen::Index k = 0; k < 9; ++k) {
      EXPECT_EQ(fit.deviation[k] > 0.0, k == one);
      if (k != one) {
        EXPECT_EQ(fit.network.theta()[k], network.theta()[k]);
      }
    }
  }
}

TEST(StructuredLevenbergMarquardt, MeasurementsThatDoNotFitAreRefused) {
  const testing::Recording r(samples);
  Vector theta = testing::network(1, 1).theta();
  theta[8] = 0.0;  // static
  const StructuredNetwork still(theta, Wavelet()), fed_back = testing::network(1, 1);
  const Vector full = r.speed, cut = r.speed.head(samples - 1), none;
  const std::vector<bool> all(9, true);
  const auto fit = [](const StructuredNetwork& network, const StructuredMeasurements& data,
                      const std::vector<bool>& learn) {
    return StructuredLevenbergMarquardt{.iterations = 1}.fit(network, data, learn);
  };
  EXPECT_NO_THROW(fit(still, {r.signals(), full, none}, all));
  expect_refused([&] { fit(still, {r.signals(), cut, none}, all); });
  expect_refused([&] { fit(still, {r.signals(), full, cut}, all); });
  expect_refused([&] { fit(still, {r.signals(), full, none}, std::vector<bool>(8, true)); });
  expect_refused([&] { fit(still, {r.signals(), full, none}, std::vector<bool>(9, false)); });
  expect_refused([&] { fit(fed_back, {r.signals(), full, none, 1.0, Feed::simulated}, all); });
  EXPECT_NO_THROW(fit(still, {r.signals(), full, none, 1.0, Feed::simulated}, all));
  expect_refused([&] { simulate_plant(still, r.signals(), cut); });
  expect_refused([] { feed_by_name("guessed"); });
}

TEST(StructuredLevenbergMarquardt, APlantThatRunsAwayIsNoStart) {
  testing::Recording r(4000);
  Vector theta = testing::network(0, 1).theta();
  theta[0] = -400.0;  // friction that drives
  const Vector none;
  const StructuredNetwork wild(theta, Wavelet());
  for (const bool weights_first : {false, true}) {
    const StructuredLevenbergMarquardt trainer{.weights_first = weights_first};
    expect_refused([&] { trainer.fit(wild, {r.signals(), r.speed, none}, std::vector<bool>(5, true)); });
  }
}

TEST(Rates, ValuesForAnotherNumberOfGroupsAreRefused) {
  const StructuredNetwork network = testing::network(1, 1);
  StructuredMask learn{};
  learn.fill(true);
  expect_refused([&] { FixedRates{std::vector<double>(3, 0.1)}.on(network, learn); });
  expect_refused([&] { NormalisedRates{.scales = std::vector<double>(3, 0.1)}.on(network, learn); });
  EXPECT_NO_THROW(FixedRates{std::vector<double>(9, 0.1)}.on(network, learn));
  EXPECT_NO_THROW(NormalisedRates{.scales = std::vector<double>(9, 0.1)}.on(network, learn));
  expect_refused([] { maxima_by_name("always"); });
}

TEST(Rates, WhatDoesNotLearnHasNoRateAndARateThatIsSharedIsSmaller) {
  const testing::Recording r(400);
  const StructuredNetwork network = testing::network(2, 3);
  StructuredMask some{};
  some[kV1] = some[kTranslation] = true;
  for (const bool shared : {false, true}) {
    auto rates = ImpulseResponseRates{.fraction = 0.1, .shared = shared}.on(network, some);
    StructuredRun run(network);
    run.want(false, true);
    rates->prepare(run, r.signals());
    const StructuredRateValues values = rates->rates(), bounds = rates->bounds();
    for (std::size_t g = 0; g < values.size(); ++g) {
      EXPECT_EQ(values[g] > 0.0, some[g]) << g;
      if (some[g]) {
        EXPECT_NEAR(values[g] * bounds[g] * bounds[g], 0.2 / (shared ? 2.0 : 1.0), 1e-12);
      }
    }
  }
}

TEST(Rates, ARecurrentNetworkOfZeroWeightsHasItsBoundsAsTheyAre) {
  Vector theta = Vector::Constant(1 + 1 + 4, 0.4);
  RecurrentMask learn{};
  learn.fill(true);
  learn[kShift] = false;
  const RowMatrix inputs = RowMatrix::Random(60, 1);
  const Vector output = Vector::Constant(60, 3.0);
  for (const double weight : {0.0, 1e-3}) {
    theta[2] = weight;
    for (const bool shared : {false, true}) {
      const RecurrentNetwork network(theta, 1, Wavelet());
      auto rates = ImpulseResponseRates{.fraction = 0.0, .shared = shared}.on(network, learn);
      RecurrentRun run(network);
      rates->prepare(run, {inputs, output});
      const RecurrentRateValues values = rates->rates(), bounds = rates->bounds();
      EXPECT_EQ(values[kShift], 0.0);
      EXPECT_NEAR(values[kOutput] * bounds[kOutput] * bounds[kOutput], 0.5 / (shared ? 5.0 : 1.0), 1e-12);
      EXPECT_EQ(bounds[kScale] > 0.0, weight > 0.0);
      EXPECT_EQ(values[kScale] > 0.0, weight > 0.0);
    }
  }
}

TEST(OnlineTraining, OptionsThatNoRunHasAreRefused) {
  const testing::Recording r(samples);
  const StructuredNetwork network = testing::network(1, 1);
  StructuredMask learn{};
  learn.fill(true);
  auto rates = FixedRates{std::vector<double>(9, 1e-9)}.on(network, learn);
  const auto run = [&](int cycles, int every) {
    OnlineOptions options;
    options.cycles = cycles;
    options.frozen_every = every;
    return train(network, r.signals(), *rates, learn, options);
  };
  expect_refused([&] { run(0, 0); });
  expect_refused([&] { run(1, -1); });
  EXPECT_EQ(run(3, 2).history.frozen_after, (std::vector<int>{0, 2, 3}));
}

TEST(OnlineTraining, WhatIsNotLearnedIsNotMoved) {
  const testing::Recording r(400);
  const StructuredNetwork network = testing::network(2, 5);
  const Eigen::Index first[] = {0, 1, 2, 3, 4, 5, 7, 9, 11, 13};  // of each group, and behind the last
  for (std::size_t g = 0; g < kStructuredGroups; ++g) {
    StructuredMask learn{};
    learn[g] = true;
    auto rates = FixedRates{std::vector<double>(9, 1e-7)}.on(network, learn);
    const auto done = train(network, r.signals(), *rates, learn, {});
    for (Eigen::Index k = 0; k < 13; ++k) {
      const bool inside = k >= first[g] && k < first[g + 1];
      EXPECT_EQ(done.network.theta()[k] != network.theta()[k], inside) << g << " " << k;
    }
  }
}

TEST(SideBySide, SizesThatDoNotFitAreRefused) {
  const testing::Recording r(samples);
  const RowMatrix theta = testing::network(1, 1).theta().transpose().replicate(2, 1);
  const RowMatrix rates = RowMatrix::Constant(2, kStructuredGroups, 1e-9);
  const auto run = [&](const RowMatrix& of, const RowMatrix& by, int cycles) {
    return train_side_by_side(of, Wavelet(), by, r.signals(), cycles);
  };
  EXPECT_NO_THROW(run(theta, rates, 1));
  expect_refused([&] { run(theta.topRows(0), rates.topRows(0), 1); });
  expect_refused([&] { run(theta, rates.topRows(1), 1); });
  expect_refused([&] { run(theta, rates.leftCols(8), 1); });
  expect_refused([&] { run(theta, rates, 0); });
}

TEST(SideBySide, WithoutItsWindingOnlyWhatLearnsMoves) {
  const testing::Recording r(200);
  const RowMatrix theta = testing::network(1, 1).theta().transpose().replicate(2, 1);
  for (const int group : {0, 3, 4}) {  // v1; v4 and v5 are the winding's
    RowMatrix rates = RowMatrix::Zero(2, kStructuredGroups);
    rates.col(group).setConstant(1e-7);
    const SideBySide done = train_side_by_side(theta, Wavelet(), rates, r.signals(), 2);
    for (Eigen::Index k = 0; k < theta.cols(); ++k) {
      EXPECT_EQ(done.theta(0, k) != theta(0, k), k == group) << group << " " << k;
      EXPECT_EQ(done.theta(0, k), done.theta(1, k));
    }
  }
}

}  // namespace
}  // namespace rwn
