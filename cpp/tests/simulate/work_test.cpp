// What simulations cost, as they count it.
#include "rwn/simulate/work.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "effect_index.hpp"
#include "rwn/simulate/simulate.hpp"

namespace {

constexpr double inertia = 1e-4, sample_time = 1e-3;

/// Cost of the run of a 24 V motor under a slow sine, with derivatives by its first parameters; `bristle_damping`: of
/// presliding friction, 0 for none.
long cost(int samples, int derivatives, double bristle_damping = 0.0) {
  std::vector<double> time, input, parameters(static_cast<std::size_t>(rwn::parameter_count()));
  for (int k = 0; k < samples; ++k) {
    time.push_back(sample_time * k);
    input.push_back(12.0 * std::sin(0.02 * k));
  }
  parameters[rwn::resistance] = 1.2;
  parameters[rwn::inductance] = 2e-3;
  parameters[rwn::torque_constant] = parameters[rwn::back_emf_constant] = 0.05;
  parameters[rwn::inertia] = inertia;
  parameters[rwn::viscous_friction] = 2e-5;
  const std::vector<int> presliding{rwn::effect_index("presliding-hysteresis")};
  const auto of_bristle = static_cast<std::size_t>(rwn::first_parameter(presliding.front()));
  parameters[of_bristle] = 20.0;
  parameters[of_bristle + 1] = bristle_damping;
  parameters[of_bristle + 2] = 0.02;
  std::vector<int> by(static_cast<std::size_t>(derivatives));
  std::iota(by.begin(), by.end(), 0);
  rwn::Work work;
  rwn::SimulationTask task;
  task.time = time;
  task.input = input;
  task.parameters = parameters;
  task.by = by;
  task.work = &work;
  if (bristle_damping != 0.0) task.active = presliding;
  const rwn::SimulationStatus status = rwn::simulate(task, {});
  EXPECT_TRUE(status == rwn::SimulationStatus::ok || bristle_damping > 20.0);  // too fast for the rows: may run away
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

TEST(Work, OfARowIsBoundedHoweverFastABristleIs) {
  const double fastest = 170.0 / sample_time * inertia;  // [N m s/rad]; its friction settles 170 times between two rows
  EXPECT_GT(cost(400, 4, fastest), 5 * cost(400, 4, 0.1 * fastest));
  EXPECT_LT(cost(400, 4, 4.0 * fastest), 2 * cost(400, 4, fastest));
}

}  // namespace
