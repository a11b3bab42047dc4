#include "rwn/simulate/transfer_function.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "allocations.hpp"
#include "effect_index.hpp"
#include "rwn/fit/normal_equations.hpp"
#include "rwn/simulate/simulate.hpp"

namespace {

struct Case {
  std::vector<double> time, input, parameters;
  std::vector<int> active, by;
  int order = 3;

  double& b(int k) { return at(rwn::numerator + k); }
  double& a(int k) { return at(rwn::denominator + k); }
  double& x(int i) { return at(rwn::initial_state + i - 1); }
  double& at(int k) { return parameters[static_cast<std::size_t>(rwn::first_coefficient() + k)]; }
  double& of(int effect, int k) { return parameters[static_cast<std::size_t>(rwn::first_parameter(effect) + k)]; }

  rwn::SimulationTask task() const {
    rwn::SimulationTask t;
    t.drive = rwn::drive_of("lti");
    t.time = time;
    t.input = input;
    t.parameters = parameters;
    t.active = active;
    t.by = by;
    t.order = order;
    return t;
  }
  std::vector<double> output() const {
    std::vector<double> y(time.size());
    EXPECT_EQ(rwn::simulate(task(), {{}, y, {}, {}, {}, {}}), rwn::SimulationStatus::ok);
    return y;
  }
};

Case make(int order, int samples = 300, double step = 0.02) {
  Case c;
  c.order = order;
  c.parameters.assign(static_cast<std::size_t>(rwn::parameter_count()), 0.0);
  for (int k = 0; k < samples; ++k) {
    c.time.push_back(step * k);
    c.input.push_back(std::sin(0.3 * k * step * k) > 0.0 ? 1.5 : -1.0);
  }
  return c;
}

/// A slow pole beside a belt resonance near 4 Hz.
Case belt() {
  Case c = make(3);
  const double slow = 2.0, rate = 25.0, damping = 0.1;
  c.a(2) = slow + 2.0 * damping * rate;
  c.a(1) = rate * rate + 2.0 * damping * rate * slow;
  c.a(0) = rate * rate * slow;
  c.b(0) = 1500.0;
  c.b(1) = -40.0;
  c.b(2) = 0.5;
  return c;
}

void check_slopes(Case c) {
  const std::size_t n = c.time.size(), p = c.by.size();
  std::vector<double> y(n), slopes(n * p);
  ASSERT_EQ(rwn::simulate(c.task(), {{}, y, {}, {}, slopes, {}}), rwn::SimulationStatus::ok);
  for (std::size_t j = 0; j < p; ++j) {
    const auto index = static_cast<std::size_t>(c.by[j]);
    const double value = c.parameters[index], nudge = 1e-6 * (value != 0.0 ? std::abs(value) : 1.0);
    Case up = c, down = c;
    up.parameters[index] += nudge;
    down.parameters[index] -= nudge;
    const auto high = up.output(), low = down.output();
    double error = 0.0, size = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
      const double difference = (high[k] - low[k]) / (2.0 * nudge);
      error += std::pow(difference - slopes[k * p + j], 2);
      size += difference * difference;
    }
    EXPECT_GT(size, 0.0) << "parameter " << index << " does nothing";
    EXPECT_LE(std::sqrt(error), 1e-5 * std::sqrt(size)) << "parameter " << index;
  }
}

}  // namespace

TEST(TransferFunction, FirstOrderStepIsTheExponential) {
  Case c = make(1, 50, 0.1);
  c.a(0) = 4.0;
  c.b(0) = 12.0;
  c.x(1) = -1.0;
  for (double& u : c.input) u = 2.0;
  const auto y = c.output();
  for (std::size_t k = 0; k < y.size(); ++k) EXPECT_NEAR(y[k], 6.0 - 7.0 * std::exp(-4.0 * c.time[k]), 1e-12);
}

TEST(TransferFunction, SecondOrderRingsAsItShould) {
  Case c = make(2, 200, 0.013);
  const double rate = 9.0, damping = 0.05;
  c.a(1) = 2.0 * damping * rate;
  c.a(0) = rate * rate;
  c.b(0) = rate * rate;
  for (double& u : c.input) u = 1.0;
  const double ring = rate * std::sqrt(1.0 - damping * damping);
  const auto y = c.output();
  for (std::size_t k = 0; k < y.size(); ++k) {
    const double t = c.time[k];
    const double wanted =
        1.0 - std::exp(-damping * rate * t) * (std::cos(ring * t) + damping * rate / ring * std::sin(ring * t));
    EXPECT_NEAR(y[k], wanted, 1e-11);
  }
}

TEST(TransferFunction, IntegratorAndTwentiethOrderAreExact) {
  Case ramp = make(1, 40, 0.1);
  ramp.b(0) = 3.0;
  for (double& u : ramp.input) u = 0.5;
  const auto y = ramp.output();
  for (std::size_t k = 0; k < y.size(); ++k) EXPECT_NEAR(y[k], 1.5 * ramp.time[k], 1e-12);

  Case chain = make(20, 60, 0.05);  // (s + 8)^20: the step response is a sum of an exponential series
  double binomial = 1.0;
  for (int k = 20; k >= 1; --k) {
    binomial *= static_cast<double>(k) / (21 - k);
    chain.a(k - 1) = binomial * std::pow(8.0, 21 - k);
  }
  chain.b(0) = chain.a(0);
  for (double& u : chain.input) u = 1.0;
  const auto z = chain.output();
  for (std::size_t k = 0; k < z.size(); ++k) {
    double sum = 0.0, term = 1.0;
    for (int j = 0; j < 20; ++j) {
      sum += term;
      term *= 8.0 * chain.time[k] / (j + 1);
    }
    EXPECT_NEAR(z[k], 1.0 - sum * std::exp(-8.0 * chain.time[k]), 1e-6);
  }
}

TEST(TransferFunction, TheSampleTimeDoesNotMatter) {
  Case fine = belt();
  for (std::size_t k = 0; k < fine.input.size(); ++k) fine.input[k] = fine.input[k - k % 10];
  Case coarse = fine;
  coarse.time.clear();
  coarse.input.clear();
  for (std::size_t k = 0; k < fine.time.size(); k += 10) {
    coarse.time.push_back(fine.time[k]);
    coarse.input.push_back(fine.input[k]);
  }
  const auto a = fine.output(), b = coarse.output();
  for (std::size_t k = 0; k < b.size(); ++k) EXPECT_NEAR(a[10 * k], b[k], 1e-10);
}

TEST(TransferFunction, SlopesAgreeWithCentralDifferences) {
  Case c = belt();
  c.x(1) = 0.4;
  c.x(2) = 3.0;
  c.x(3) = -50.0;
  for (int k = 0; k < 3; ++k) {
    c.by.push_back(rwn::first_coefficient() + rwn::numerator + k);
    c.by.push_back(rwn::first_coefficient() + rwn::denominator + k);
    c.by.push_back(rwn::first_coefficient() + rwn::initial_state + k);
  }
  check_slopes(c);
}

TEST(TransferFunction, ActuatorAndSensorEffectsAttachWithTheirSlopes) {
  for (const auto& [name, values] :
       std::vector<std::pair<std::string_view, std::vector<double>>>{{"actuator-deadzone", {0.2}},
                                                                     {"voltage-saturation", {1.2}},
                                                                     {"input-delay", {0.033}},
                                                                     {"speed-sensor-lag", {0.05}},
                                                                     {"sensor-bias", {0.3}},
                                                                     {"sensor-rectification", {1.4, 2.0}}}) {
    SCOPED_TRACE(std::string(name));
    Case c = belt();
    const auto plain = c.output();
    const int effect = rwn::effect_index(name);
    ASSERT_GE(effect, 0);
    c.active = {effect};
    for (std::size_t k = 0; k < values.size(); ++k) c.of(effect, static_cast<int>(k)) = values[k];
    EXPECT_NE(c.output(), plain);
    c.by = {rwn::first_coefficient() + rwn::numerator, rwn::first_coefficient() + rwn::denominator + 2,
            rwn::first_parameter(effect)};
    check_slopes(c);
  }
}

TEST(TransferFunction, RectifierShowsTheMagnitude) {
  Case c = belt();
  const auto plain = c.output();
  c.active = {rwn::effect_index("sensor-rectification")};
  c.of(c.active[0], 0) = 1.0;
  c.of(c.active[0], 1) = 2.0;
  const auto seen = c.output();
  for (std::size_t k = 0; k < seen.size(); ++k) EXPECT_NEAR(seen[k], std::abs(plain[k]), 1e-12);
}

TEST(TransferFunction, InstabilityIsAStatusAndAWrongOrderIsRefused) {
  Case c = belt();
  c.a(2) = -300.0;
  std::vector<double> y(c.time.size());
  EXPECT_EQ(rwn::simulate(c.task(), {{}, y, {}, {}, {}, {}}), rwn::SimulationStatus::diverged);
  for (double v : y) EXPECT_TRUE(std::isfinite(v));
  c.order = 21;
  EXPECT_THROW(rwn::simulate(c.task(), {{}, y, {}, {}, {}, {}}), std::invalid_argument);
}

TEST(TransferFunction, NoAllocationPerSample) {
  const auto count = [](int samples) {
    Case c = make(3, samples);
    c.a(2) = c.a(1) = c.a(0) = 5.0;
    c.b(0) = 5.0;
    c.by = {rwn::first_coefficient()};
    std::vector<double> y(c.time.size()), slopes(c.time.size());
    const long before = rwn::testing::allocations();
    rwn::simulate(c.task(), {{}, y, {}, {}, slopes, {}});
    return rwn::testing::allocations() - before;
  };
  EXPECT_EQ(count(100), count(1000));
}
