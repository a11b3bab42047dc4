#include "rwn/networks/trainers.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "allocations.hpp"
#include "conventional_fixture.hpp"

namespace {

using namespace rwn;
using rwn::testing::allocations;
using rwn::testing::random_matrix;
using rwn::testing::random_network;

struct Problem {
  ConventionalNetwork truth, start;
  RowMatrix x, y;
};

/// Patterns made by a network, and a start a little off it.
Problem planted(const ConventionalShape& shape) {
  std::mt19937 random(5);
  Problem p{random_network(Wavelet(), shape, 8),
            random_network(Wavelet(), shape, 8),
            random_matrix(60, shape.inputs, random),
            {}};
  p.y = p.truth.output(p.x);
  p.start.parameters() += 0.05 * Eigen::VectorXd(random_matrix(shape.size(), 1, random));
  return p;
}

TEST(GradientDescent, FirstStepIsTheMeanGradient) {
  const Problem p = planted({2, 5, 2});
  const Training t = GradientDescent{.rate = 1e-3, .momentum = 0.0, .iterations = 1}.train(p.start, Patterns(p.x, p.y));
  const Eigen::VectorXd want = p.start.parameters() - 1e-3 / 60.0 * p.start.gradient(p.x, p.y);
  EXPECT_LT((t.network.parameters() - want).norm(), 1e-14);
  EXPECT_EQ(t.mse.size(), 2u);
  EXPECT_EQ(t.status, TrainingStatus::iteration_limit);
}

TEST(GradientDescent, MomentumRepeatsTheLastStep) {
  const Problem p = planted({1, 4, 1});
  const Patterns patterns(p.x, p.y);
  const auto after = [&](int n) {
    return GradientDescent{.rate = 1e-3, .momentum = 0.7, .iterations = n}
        .train(p.start, patterns)
        .network.parameters();
  };
  const ConventionalNetwork one(p.start.wavelet(), p.start.shape(), after(1));
  const Eigen::VectorXd want =
      after(1) - 1e-3 / 60.0 * one.gradient(p.x, p.y) + 0.7 * (after(1) - p.start.parameters());
  EXPECT_LT((after(2) - want).norm(), 1e-14);
}

TEST(GradientDescent, DivergenceIsReportedAndTheBestNetworkReturned) {
  const Problem p = planted({1, 4, 1});
  const Training t = GradientDescent{.rate = 50.0}.train(p.start, Patterns(p.x, p.y));
  EXPECT_EQ(t.status, TrainingStatus::diverged);
  EXPECT_TRUE(t.network.parameters().allFinite());
  EXPECT_LE(t.frozen_mse, t.mse.front());
  EXPECT_FALSE(advice(t.status).empty());
}

TEST(GradientDescent, ARunWithoutStepsStalls) {
  const Problem p = planted({1, 4, 1});
  EXPECT_EQ(GradientDescent{.rate = 0.0}.train(p.start, Patterns(p.x, p.y)).status, TrainingStatus::stalled);
}

TEST(GradientDescent, AllocatesNothingInItsLoop) {
  const Problem p = planted({2, 7, 1});
  const Patterns patterns(p.x, p.y);
  const auto count = [&](int n) {
    const long before = allocations();
    (void)GradientDescent{.rate = 1e-4, .iterations = n}.train(p.start, patterns);
    return allocations() - before;
  };
  EXPECT_EQ(count(10), count(1000));
}

TEST(PatternDescent, OnePatternIsOneGradientStep) {
  const Problem p = planted({3, 9, 2});
  const RowMatrix x = p.x.topRows(1);
  const RowMatrix y = p.y.topRows(1);
  const Training t = PatternDescent{.rate = 1e-2, .iterations = 1}.train(p.start, x, y);
  const Eigen::VectorXd want = p.start.parameters() - 1e-2 * p.start.gradient(x, y);
  EXPECT_LT((t.network.parameters() - want).norm(), 1e-14);
}

TEST(PatternDescent, AllocatesNothingInItsLoop) {
  const Problem p = planted({2, 7, 1});
  const auto count = [&](int n) {
    const long before = allocations();
    (void)PatternDescent{.rate = 1e-4, .iterations = n}.train(p.start, p.x, p.y);
    return allocations() - before;
  };
  EXPECT_EQ(count(10), count(1000));
}

TEST(PatternDescent, ReportsTheFrozenErrorBesideTheTrackingError) {
  const Problem p = planted({1, 7, 1});
  const Training t = PatternDescent{.rate = 1e-2, .iterations = 20}.train(p.start, p.x, p.y);
  EXPECT_NEAR(t.frozen_mse, (t.network.output(p.x) - p.y).squaredNorm() / 60.0, 1e-12 * t.frozen_mse);
  EXPECT_NE(t.frozen_mse, t.mse.back());
}

TEST(PatternGaussNewton, ReturnsToThePlantedNetwork) {
  const Problem p = planted({2, 4, 2});
  const Training t = PatternGaussNewton{.noise = 1e-2, .iterations = 100}.train(p.start, p.x, p.y);
  EXPECT_LT(t.frozen_mse, 1e-8);
}

TEST(PatternGaussNewton, AllocatesNothingInItsLoop) {
  const Problem p = planted({2, 7, 1});
  const auto count = [&](int n) {
    const long before = allocations();
    (void)PatternGaussNewton{.iterations = n}.train(p.start, p.x, p.y);
    return allocations() - before;
  };
  EXPECT_EQ(count(2), count(20));
}

TEST(LevenbergMarquardt, ReturnsToThePlantedNetwork) {
  const Problem p = planted({2, 4, 2});
  const Training t = LevenbergMarquardt{.iterations = 200}.train(p.start, Patterns(p.x, p.y));
  EXPECT_LT(t.frozen_mse, 1e-24);
  EXPECT_LT((t.network.parameters() - p.truth.parameters()).norm(), 1e-9);
}

TEST(LevenbergMarquardt, NeverRaisesTheError) {
  const Problem p = planted({1, 6, 1});
  const Training t = LevenbergMarquardt{.iterations = 40}.train(p.start, Patterns(p.x, p.y));
  for (std::size_t n = 1; n < t.mse.size(); ++n) {
    EXPECT_LE(t.mse[n], t.mse[n - 1]);
  }
}

TEST(VariableProjection, ReturnsToThePlantedNetwork) {
  const Problem p = planted({2, 4, 2});
  const Training t = VariableProjection{.resolution = 0.0, .iterations = 100}.train(p.start, Patterns(p.x, p.y));
  EXPECT_LT(t.frozen_mse, 1e-24);
}

TEST(VariableProjection, SolvesForTheLinearPart) {
  Problem p = planted({1, 5, 1});
  p.start.parameters() = p.truth.parameters();
  p.start.parameters().head(p.truth.shape().m()).setZero();
  const Training t = VariableProjection{.iterations = 0}.train(p.start, Patterns(p.x, p.y));
  EXPECT_LT(t.frozen_mse, 1e-24);
}

TEST(Trainers, AllHaveNames) { EXPECT_EQ(trainer_names().size(), std::tuple_size_v<ConventionalTrainers>); }

}  // namespace
