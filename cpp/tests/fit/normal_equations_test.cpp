#include "rwn/fit/normal_equations.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "motor_fixture.hpp"
#include "rwn/simulate/simulate.hpp"

TEST(NormalEquations, AreTheSumsOverTheSamples) {
  Case c = motor();
  c.by = {rwn::resistance, rwn::inertia};
  const std::size_t n = c.time.size();
  std::vector<double> speed(n), slopes(2 * n);
  rwn::simulate(c.task(), {{}, speed, {}, {}, slopes, {}});
  std::vector<double> measured(n);
  double chi2 = 0.0, gradient = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    measured[k] = speed[k] + std::sin(0.1 * static_cast<double>(k));
    const double e = 2.0 * (measured[k] - speed[k]);
    chi2 += e * e;
    gradient += 2.0 * slopes[2 * k + 1] * e;
  }
  rwn::Measurements recorded;
  recorded.speed = measured;
  recorded.speed_weight = 2.0;
  const auto sum = rwn::normal_equations(c.task(), recorded);
  EXPECT_NEAR(sum.chi2, chi2, 1e-9 * chi2);
  EXPECT_NEAR(sum.gradient[1], gradient, 1e-9 * std::abs(gradient));
  EXPECT_EQ(sum.count, static_cast<long>(n));
}

TEST(NormalEquations, OfErrorsThatLastCountWhatIsNew) {
  Case c = motor();
  c.by = {rwn::resistance, rwn::inertia};
  const std::size_t n = c.time.size();
  std::vector<double> speed(n), slopes(2 * n), measured(n);
  rwn::simulate(c.task(), {{}, speed, {}, {}, slopes, {}});
  const double share = 0.9, alone = std::sqrt(1.0 - share * share);
  double chi2 = 0.0, gradient = 0.0, last = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    const double error = std::sin(0.1 * static_cast<double>(k));
    measured[k] = speed[k] + error;
    const double fresh = k == 0 ? alone * error : error - share * last;
    const double slope = k == 0 ? alone * slopes[1] : slopes[2 * k + 1] - share * slopes[2 * k - 1];
    chi2 += fresh * fresh;
    gradient += slope * fresh;
    last = error;
  }
  rwn::Measurements recorded;
  recorded.speed = measured;
  recorded.reflection = {{{}, {share}, {}}};
  const auto sum = rwn::normal_equations(c.task(), recorded);
  EXPECT_NEAR(sum.chi2, chi2, 1e-9 * chi2);
  EXPECT_NEAR(sum.gradient[1], gradient, 1e-9 * std::abs(gradient));
}
