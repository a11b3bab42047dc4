#include <gtest/gtest.h>

#include <cmath>

#include "rwn/plant_analysis.hpp"
#include "rwn/trainers/recursive_gauss_newton.hpp"
#include "rwn/trainers/structured_levenberg_marquardt.hpp"

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
  const auto fit = StructuredLevenbergMarquardt{.gauge = false}.fit({wrong, Wavelet()}, {r.signals(), r.speed, current, 1.0},
                                                                    std::vector<bool>(5, true));
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

TEST(ImpulseSums, AreInfiniteForAnUnstablePlant) {
  EXPECT_TRUE(std::isinf(impulse_sums(Eigen::Matrix2d::Identity()).mechanical));
}

}  // namespace
}  // namespace rwn
