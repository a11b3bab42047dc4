#include <gtest/gtest.h>

#include <cmath>

#include "allocations.hpp"
#include "rwn/networks/plant_analysis.hpp"
#include "rwn/networks/trainers/recursive_gauss_newton.hpp"
#include "rwn/networks/trainers/structured_feeds.hpp"
#include "rwn/networks/trainers/structured_levenberg_marquardt.hpp"

namespace rwn {
namespace {

constexpr double kSampleTime = 1e-4;

StructuredNetwork motor(double inertia, double viscous, Eigen::Index wavelets = 0) {
  Vector theta = Vector::Zero(5 + 4 * wavelets);
  theta.head(5) << viscous, kSampleTime / inertia, 0.055, 0.125, 0.95;
  for (Eigen::Index j = 0; j < wavelets; ++j) {
    theta[5 + wavelets + j] = -1.0 + 2.0 * static_cast<double>(j) / static_cast<double>(wavelets - 1);
    theta[5 + 2 * wavelets + j] = 0.4;
  }
  return {theta, Wavelet()};
}

struct Recording {
  Vector input, speed;
  explicit Recording(const StructuredNetwork& plant) : input(4000), speed(Vector::Zero(4000)) {
    for (Eigen::Index k = 0; k < input.size(); ++k) {
      const double t = kSampleTime * static_cast<double>(k);
      input[k] = std::sin(40.0 * t * t + 5.0 * t);
    }
    speed = simulate(plant, {input, speed});
  }
  StructuredSignals signals() const { return {input, speed}; }
};

TEST(RecursiveGaussNewton, FindsInertiaAndFriction) {
  const Recording r(motor(1.8e-4, 0.06));
  Vector spread = Vector::Zero(5);
  spread[0] = 0.03;
  spread[1] = 0.5;
  RecursiveGaussNewton trainer;
  trainer.cycles = 3;
  const auto fit = trainer.train(motor(1.2e-4, 0.08), r.signals(), spread);
  EXPECT_EQ(fit.history.status, OnlineStatus::completed);
  EXPECT_NEAR(fit.network.theta()[0] / 0.06, 1.0, 1e-6);
  EXPECT_NEAR(fit.network.theta()[1] / (kSampleTime / 1.8e-4), 1.0, 1e-6);
  EXPECT_GT(fit.deviation[0], 0.0);
  EXPECT_EQ(fit.deviation[2], 0.0);
}

TEST(RecursiveGaussNewton, RefusesASpreadThatDoesNotFit) {
  const Recording r(motor(1.8e-4, 0.06));
  EXPECT_THROW(RecursiveGaussNewton{}.train(motor(1.8e-4, 0.06), r.signals(), Vector::Zero(5)), std::invalid_argument);
  EXPECT_THROW(RecursiveGaussNewton{}.train(motor(1.8e-4, 0.06), r.signals(), Vector::Ones(4)), std::invalid_argument);
}

TEST(StructuredLevenbergMarquardt, FindsEveryLinearParameterWithTheCurrent) {
  const StructuredNetwork plant = motor(1.8e-4, 0.06);
  const Recording r(plant);
  Vector current(r.input.size());
  Eigen::Vector2d x(0.0, 0.0);
  for (Eigen::Index n = 0; n < current.size(); ++n) {
    current[n] = x[1];
    x = plant.plant() * x + Eigen::Vector2d(0.0, plant.theta()[3] * r.input[n]);
  }
  Vector wrong = plant.theta();
  wrong.array() *= Eigen::Array<double, 5, 1>(1.2, 0.85, 1.1, 0.9, 0.99);
  const auto fit = StructuredLevenbergMarquardt{.gauge = false}.fit(
      {wrong, Wavelet()}, {r.signals(), r.speed, current, 1.0}, std::vector<bool>(5, true));
  EXPECT_EQ(fit.status, FitStatus::converged);
  EXPECT_LT((fit.network.theta() - plant.theta()).cwiseQuotient(plant.theta()).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(StructuredLevenbergMarquardt, TheGaugeTakesTheSlopeOutOfTheNetwork) {
  const Recording r(motor(1.8e-4, 0.06));
  std::vector<bool> learn(5 + 4 * 7, false);
  learn[0] = true;
  std::fill(learn.begin() + 5, learn.begin() + 5 + 7, true);  // B and w: a network that could carry the slope
  const Vector none;
  const auto fit = StructuredLevenbergMarquardt{}.fit(motor(1.8e-4, 0.03, 7), {r.signals(), r.speed, none, 1.0}, learn);
  EXPECT_NEAR(fit.network.theta()[0] / 0.06, 1.0, 1e-6);
  EXPECT_LT(fit.mse.back(), 1e-12 * fit.mse.front());
}

StructuredNetwork with_friction() {
  StructuredNetwork plain = motor(1.8e-4, 0.06, 7);
  Vector theta = plain.theta();
  for (Eigen::Index j = 0; j < 7; ++j) {
    theta[5 + j] = 0.01 * static_cast<double>(j - 2);
  }
  return {theta, plain.wavelet()};
}

TEST(SimulatedFeed, DerivativesAgreeWithDifferences) {
  const StructuredNetwork net = with_friction();
  const Vector reference = Vector::LinSpaced(200, -1.2, 1.4);
  SimulatedFeed feed(net, reference, true);
  const double speed = 0.37, step = 1e-6;
  const FrictionSample at = feed(0, speed);
  const Eigen::RowVectorXd by_parameter = Eigen::Map<const Eigen::RowVectorXd>(at.by_parameter, 28);
  EXPECT_NEAR(at.by_speed, (feed(0, speed + step).torque - feed(0, speed - step).torque) / (2 * step), 1e-8);
  for (Eigen::Index k = 0; k < 21; ++k) {  // c stays 0
    Vector up = net.theta(), down = net.theta();
    up[5 + k] += step;
    down[5 + k] -= step;
    const StructuredNetwork above(up, net.wavelet()), below(down, net.wavelet());
    const double difference = SimulatedFeed(above, reference, true)(0, speed).torque -
                              SimulatedFeed(below, reference, true)(0, speed).torque;
    EXPECT_NEAR(by_parameter[k], difference / (2 * step), 1e-8) << k;
  }
}

TEST(SimulatedFeed, AgreesWithTheMeasuredFeedAlongTheSameSpeed) {
  const StructuredNetwork net = with_friction();
  const Vector speed = Vector::LinSpaced(300, -1.5, 1.5);
  const MeasuredFeed measured(net, speed, true);
  SimulatedFeed simulated(net, speed, true);
  EXPECT_NEAR(measured.slope(), simulated.slope(), 1e-15);
  for (Eigen::Index n = 0; n < speed.size(); n += 37) {
    const FrictionSample one = measured(n, 0.0), other = simulated(n, speed[n]);
    EXPECT_NEAR(one.torque, other.torque, 1e-14);
    for (Eigen::Index k = 0; k < 21; ++k) {
      EXPECT_NEAR(one.by_parameter[k], other.by_parameter[k], 1e-13);
    }
  }
}

TEST(SimulatedFeed, AllocatesNothingPerSample) {
  const StructuredNetwork net = with_friction();
  SimulatedFeed feed(net, Vector::LinSpaced(50, -1.0, 1.0), true);
  const long before = testing::allocations();
  double sum = 0.0;
  for (Eigen::Index n = 0; n < 1000; ++n) {
    sum += feed(n, 1e-3 * static_cast<double>(n)).torque;
  }
  EXPECT_EQ(testing::allocations(), before);
  EXPECT_TRUE(std::isfinite(sum));
}

TEST(StructuredLevenbergMarquardt, RefusesToFeedBackANetworkWithMemory) {
  const Recording r(motor(1.8e-4, 0.06));
  Vector theta = with_friction().theta();
  theta[5 + 21] = 0.1;
  const Vector none;
  EXPECT_THROW(StructuredLevenbergMarquardt{}.fit(
                   {theta, Wavelet()}, {r.signals(), r.speed, none, 1.0, Feed::simulated}, std::vector<bool>(33, true)),
               std::invalid_argument);
  EXPECT_THROW(feed_by_name("other"), std::invalid_argument);
}

TEST(ImpulseSums, AreInfiniteForAnUnstablePlant) {
  EXPECT_TRUE(std::isinf(impulse_sums(Eigen::Matrix2d::Identity()).mechanical));
}

}  // namespace
}  // namespace rwn
