// What simulations cost, as they count it.
#include "rwn/simulate/work.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "rwn/simulate/simulate.hpp"

namespace {

/// Cost of the run of a 24 V motor under a slow sine, with derivatives by its first parameters.
long cost(int samples, int derivatives) {
  std::vector<double> time, input, parameters(static_cast<std::size_t>(rwn::parameter_count()));
  for (int k = 0; k < samples; ++k) {
    time.push_back(1e-3 * k);
    input.push_back(12.0 * std::sin(0.02 * k));
  }
  parameters[rwn::resistance] = 1.2;
  parameters[rwn::inductance] = 2e-3;
  parameters[rwn::torque_constant] = parameters[rwn::back_emf_constant] = 0.05;
  parameters[rwn::inertia] = 1e-4;
  parameters[rwn::viscous_friction] = 2e-5;
  std::vector<int> by(static_cast<std::size_t>(derivatives));
  std::iota(by.begin(), by.end(), 0);
  rwn::Work work;
  rwn::SimulationTask task;
  task.time = time;
  task.input = input;
  task.parameters = parameters;
  task.by = by;
  task.work = &work;
  EXPECT_EQ(rwn::simulate(task, {}), rwn::SimulationStatus::ok);
  return work.done();
}

TEST(Work, AddsUp) {
  rwn::Work work;
  work.add(3);
  work.add(4);
  EXPECT_EQ(work.done(), 7);
}

TEST(Work, OfARunGrowsWithItsLengthAndItsDerivatives) {
  EXPECT_GT(cost(400, 0), 0);
  EXPECT_EQ(cost(400, 4), cost(400, 4));
  EXPECT_NEAR(static_cast<double>(cost(800, 4)), 2.0 * static_cast<double>(cost(400, 4)),
              0.2 * static_cast<double>(cost(400, 4)));
  EXPECT_GT(cost(400, 4), cost(400, 0));
  EXPECT_GT(cost(400, 6), cost(400, 4));
}

}  // namespace
