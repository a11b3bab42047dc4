#include "rwn/simulate/simulate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "allocations.hpp"
#include "motor_fixture.hpp"
#include "rwn/model/effects.hpp"

namespace {

/// A scale in SI for the motor of the fixture.
double size_of(const rwn::Scale& scale) {
  constexpr double sizes[] = {0.5, 100.0, 12.0, 5.0, 3e-4, 1e-3, 0.3977, 20.0};  // as in Scale::quantities
  double size = scale.factor;
  for (std::size_t k = 0; k < scale.powers.size(); ++k) size *= std::pow(sizes[k], scale.powers[k]);
  return size;
}

/// First guesses of one effect, in SI for the motor of the fixture.
void switch_on(Case& c, int effect, const rwn::Parameter* parameters, std::size_t count) {
  c.active = {effect};
  for (std::size_t k = 0; k < count; ++k) {
    const rwn::Parameter& p = parameters[k];
    const double unit = size_of(p.scale);
    c.parameters[static_cast<std::size_t>(rwn::first_parameter(effect)) + k] = p.start * unit;
  }
}

/// Place of an effect in the table.
template <class E>
int place_of() {
  return []<std::size_t... I>(std::index_sequence<I...>) {
    return (0 + ... + (std::is_same_v<E, std::tuple_element_t<I, rwn::Effects>> ? static_cast<int>(I) : 0));
  }(std::make_index_sequence<rwn::effect_count>{});
}

/// The current in place of the speed, by itself or with its derivatives.
std::vector<double> current_of(const Case& c, std::span<double> slopes = {}) {
  std::vector<double> current(c.time.size());
  EXPECT_EQ(rwn::simulate(c.task(), {current, {}, {}, slopes, {}, {}}), rwn::SimulationStatus::ok);
  return current;
}

/// Derivatives of the speed, or of the current, by `c.by` against central differences: over the one of three steps that
/// suits the parameter better, since a short one drowns in rounding where the parameter does little, and a long one
/// bends where it does much.
void expect_slopes(const Case& c, bool of_current = false) {
  const std::size_t p = c.by.size(), n = c.time.size();
  std::vector<double> speed(n), slopes(n * p);
  if (of_current) {
    current_of(c, slopes);
  } else {
    ASSERT_EQ(rwn::simulate(c.task(), {{}, speed, {}, {}, slopes, {}}), rwn::SimulationStatus::ok);
  }
  for (std::size_t j = 0; j < p; ++j) {
    const auto index = static_cast<std::size_t>(c.by[j]);
    const double value = c.parameters[index];
    double off = std::numeric_limits<double>::infinity();
    for (const double relative : {1e-7, 1e-6, 1e-5}) {
      const double nudge = relative * (value != 0.0 ? std::abs(value) : 1.0);
      Case up = c, down = c;
      up.parameters[index] = value + nudge;
      down.parameters[index] = value - nudge;
      const std::vector<double> high = of_current ? current_of(up) : speed_of(up);
      const std::vector<double> low = of_current ? current_of(down) : speed_of(down);
      double error = 0.0, size = 0.0;
      for (std::size_t k = 0; k < n; ++k) {
        const double difference = (high[k] - low[k]) / (2.0 * nudge);
        error += std::pow(difference - slopes[k * p + j], 2);
        size += difference * difference;
      }
      off = std::min(off, (std::sqrt(error) - 1e-12) / std::sqrt(size + 1e-300));
    }
    EXPECT_LE(off, 2e-4) << "parameter " << index;
  }
}

template <class E>
void check_slopes(int effect, bool follow) {
  SCOPED_TRACE(std::string(E::info.name) + (follow ? " on a recorded angle" : ""));
  Case c = motor();
  switch_on(c, effect, E::parameters.data(), E::parameters.size());
  if (follow) {
    for (double t : c.time) c.angle.push_back(30.0 * t + 5.0 * std::sin(20.0 * t));
  }
  for (int k = 0; k <= rwn::viscous_friction; ++k) c.by.push_back(k);
  for (std::size_t k = 0; k < E::parameters.size() && !rwn::jumps<E>(); ++k) {
    c.by.push_back(rwn::first_parameter(effect) + static_cast<int>(k));
  }
  if (rwn::jumps<E>()) {
    std::vector<double> speed(c.time.size()), slopes(c.time.size() * c.by.size());
    EXPECT_EQ(rwn::simulate(c.task(), {{}, speed, {}, {}, slopes, {}}), rwn::SimulationStatus::ok);
  } else {
    expect_slopes(c, E::traits.shows_late == "current");
  }
}

/// A motor with a cog whose speed is filtered and offset; `angle` is the integral of that speed, as a recording has it.
Case cogged_motor_without_a_position() {
  Case c = motor();
  const std::vector<std::pair<int, std::vector<double>>> effects = {
      {place_of<rwn::CoggingTorque>(), {0.01, 7.0, 0.4}},
      {place_of<rwn::SpeedSensorLag>(), {4e-3}},
      {place_of<rwn::SensorBias>(), {3.0, 0.0}}};
  for (const auto& [effect, values] : effects) {
    c.active.push_back(effect);
    for (std::size_t k = 0; k < values.size(); ++k) {
      const int index = rwn::first_parameter(effect) + static_cast<int>(k);
      c.parameters[static_cast<std::size_t>(index)] = values[k];
      c.by.push_back(index);
    }
  }
  const std::vector<double> speed = speed_of(c);
  c.angle.push_back(0.0);
  for (std::size_t k = 1; k < speed.size(); ++k) {
    c.angle.push_back(c.angle.back() + 0.5 * (c.time[k] - c.time[k - 1]) * (speed[k - 1] + speed[k]));
  }
  return c;
}

}  // namespace

TEST(Simulate, LinearMotorIsExactAtAnySampleTime) {
  Case fine = motor(401, 1e-3);
  fine.parameters[rwn::coulomb_friction] = 0.0;
  Case coarse = fine;
  coarse.time.clear();
  coarse.input.clear();
  for (std::size_t k = 0; k < fine.time.size(); ++k) fine.input[k] = fine.input[k - k % 20];
  for (std::size_t k = 0; k < fine.time.size(); k += 20) {
    coarse.time.push_back(fine.time[k]);
    coarse.input.push_back(fine.input[k]);
  }
  const auto a = speed_of(fine), b = speed_of(coarse);
  for (std::size_t k = 0; k < b.size(); ++k) EXPECT_NEAR(a[20 * k], b[k], 1e-10);
}

TEST(Simulate, AnInputActsFromItsOwnInstantsWhereRowsWereLeftOut) {
  const Case whole = motor();
  const std::vector<double> expected = speed_of(whole);
  Case kept = whole;
  kept.time.clear();
  for (std::size_t k = 0; k < whole.time.size(); k += 3) kept.time.push_back(whole.time[k]);
  rwn::SimulationTask task = kept.task();
  task.input_time = whole.time;
  std::vector<double> speed(kept.time.size());
  ASSERT_EQ(rwn::simulate(task, {{}, speed, {}, {}, {}, {}}), rwn::SimulationStatus::ok);
  for (std::size_t k = 0; k < speed.size(); ++k) EXPECT_NEAR(speed[k], expected[3 * k], 1e-9) << k;
}

TEST(Simulate, RowsWithRowsBetweenThemMoveTheSame) {
  // a winding faster than the rows, and more stops of the shaft than there is room for steps
  Case rough = motor(6000, 5e-3);
  rough.parameters[rwn::inductance] = 3e-4;
  for (std::size_t k = 0; k < rough.time.size(); ++k) {
    rough.input[k] = 6.0 * std::sin(9.0 * rough.time[k] + std::sin(0.37 * rough.time[k]));
  }
  Case fine = rough;
  fine.time.clear();
  fine.input.clear();
  for (std::size_t k = 0; k < rough.time.size(); ++k) {
    for (const double later : {0.0, 2e-3}) {
      fine.time.push_back(rough.time[k] + later);
      fine.input.push_back(rough.input[k]);
    }
  }
  const std::vector<double> speed = speed_of(rough), same = speed_of(fine);
  for (std::size_t k = 0; k < speed.size(); ++k) ASSERT_NEAR(speed[k], same[2 * k], 1e-6) << "row " << k;
}

TEST(Simulate, FrictionHoldsAtStandstill) {
  Case c = motor();
  for (double& v : c.input) v = 0.1;  // 0.0125 N m at stall, below 0.02
  for (double w : speed_of(c)) EXPECT_EQ(w, 0.0);
}

TEST(Simulate, ALoadThatPullsAShaftBackFirstDoesNotHoldItForTheWholeRow) {
  const auto hanging = [](double step) {
    Case c = motor(static_cast<int>(std::lround(0.02 / step)), step);
    for (double& v : c.input) v = 12.0;
    c.active = {place_of<rwn::ConstantLoad>()};
    c.parameters[static_cast<std::size_t>(rwn::first_parameter(c.active[0]))] = 0.022;  // above the friction of 0.02
    return speed_of(c);
  };
  const std::vector<double> rows = hanging(1e-3), fine = hanging(1e-5);
  EXPECT_GT(rows[1], 0.1);
  for (std::size_t k = 0; k < rows.size(); ++k) EXPECT_NEAR(rows[k], fine[100 * k], 1e-9) << "row " << k;
}

TEST(Simulate, FrictionHoldsAShaftWithoutElectricsAtRowsThatAreOffTheirClock) {
  Case c = motor();
  c.drive = rwn::drive_of("axis");
  const int drag = place_of<rwn::QuadraticDrag>();
  switch_on(c, drag, rwn::QuadraticDrag::parameters.data(), rwn::QuadraticDrag::parameters.size());
  for (std::size_t k = 0; k < c.time.size(); ++k) {
    c.time[k] += 2e-4 * std::sin(1.7 * static_cast<double>(k));
    c.input[k] = k < 200 ? 0.01 : 0.05;  // below the friction of 0.02 N m, and above
  }
  const std::vector<double> speed = speed_of(c);
  for (std::size_t k = 0; k <= 200; ++k) EXPECT_EQ(speed[k], 0.0);
  EXPECT_GT(speed.back(), 1.0);
}

TEST(Simulate, AnIntegratedSpeedIsFollowedWithoutWhatItsSensorAdds) {
  Case c = cogged_motor_without_a_position();
  Case free = c;
  free.angle.clear();
  const std::vector<double> truth = speed_of(free), wrong = speed_of(c);
  c.angle_from_speed = true;
  const std::vector<double> found = speed_of(c);
  double off = 0.0;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    EXPECT_NEAR(found[k], truth[k], 1e-9);
    off = std::max(off, std::abs(wrong[k] - truth[k]));
  }
  EXPECT_GT(off, 0.1);
}

TEST(Simulate, SlopesAlongAnIntegratedSpeedAgreeWithCentralDifferences) {
  Case c = cogged_motor_without_a_position();
  c.angle_from_speed = true;
  expect_slopes(c);
}

TEST(Simulate, SlopesOfEveryEffectAgreeWithCentralDifferences) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (check_slopes<std::tuple_element_t<I, rwn::Effects>>(static_cast<int>(I), false), ...);
    (check_slopes<std::tuple_element_t<I, rwn::Effects>>(static_cast<int>(I), true), ...);
  }(std::make_index_sequence<rwn::effect_count>{});
}

TEST(Simulate, DivergenceIsAStatusNotANumber) {
  Case c = motor();
  c.parameters[rwn::viscous_friction] = -50.0;
  std::vector<double> speed(c.time.size());
  EXPECT_EQ(rwn::simulate(c.task(), {{}, speed, {}, {}, {}, {}}), rwn::SimulationStatus::diverged);
  for (double w : speed) EXPECT_TRUE(std::isfinite(w));
}

TEST(Simulate, WrongLengthsAreRefused) {
  Case c = motor();
  c.input.pop_back();
  EXPECT_THROW(speed_of(c), std::invalid_argument);
}

TEST(Simulate, AllocationsDoNotGrowWithTheRecording) {
  const auto count = [](int samples) {
    Case c = motor(samples);
    c.by = {rwn::resistance, rwn::inertia, rwn::coulomb_friction};
    std::vector<double> speed(c.time.size()), slopes(3 * c.time.size());
    const rwn::SimulationTask task = c.task();
    const auto before = rwn::testing::allocations();
    rwn::simulate(task, {{}, speed, {}, {}, slopes, {}});
    return rwn::testing::allocations() - before;
  };
  EXPECT_EQ(count(400), count(4000));
}
