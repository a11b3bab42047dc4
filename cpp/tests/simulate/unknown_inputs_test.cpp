// Along a simulated motion the equations leave nothing over.
#include "rwn/simulate/unknown_inputs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace rwn {
namespace {

constexpr double step = 1e-4;

struct Case {
  int drive;
  std::vector<double> time, input, parameters;
  std::vector<int> active;

  explicit Case(const char* name) : drive(drive_of(name)) {
    const double size = drive == drive_of("axis") ? 0.12 : 12.0;
    for (int k = 0; k < 2000; ++k) {
      const double t = step * k;
      time.push_back(t);
      input.push_back(size * std::sin(2.0 * 3.14159265 * (2.0 + 20.0 * t) * t));
    }
    parameters.assign(static_cast<std::size_t>(parameter_count()), 0.0);
    parameters[resistance] = 0.8;
    parameters[inductance] = 1.5e-3;
    parameters[torque_constant] = parameters[back_emf_constant] = 0.1;
    parameters[inertia] = 3e-4;
    parameters[viscous_friction] = 7e-5;
    parameters[coulomb_friction] = 0.02;
    parameters[pendulum_torque] = 0.01;
  }

  /// Switches an effect of the table on; values in SI.
  template <class E>
  void add(const std::vector<double>& values) {
    int place = 0;
    std::apply([&](auto... e) { (void)((std::is_same_v<decltype(e), E> || (++place, false)) || ...); }, Effects{});
    active.push_back(place);
    std::copy(values.begin(), values.end(), parameters.begin() + first_parameter(place));
  }

  SimulationTask task() const {
    SimulationTask t;
    t.drive = drive;
    t.time = time;
    t.input = input;
    t.parameters = parameters;
    t.active = active;
    return t;
  }
};

struct Left {
  double torque, voltage;  // rms over that of what drives
};

/// What is left over where the shaft moves fast enough that its direction is known.
Left left_over(const Case& c) {
  const std::size_t n = c.time.size();
  std::vector<double> current(n), slope(n), speed(n), position(n), acceleration(n), torque(n), voltage(n);
  EXPECT_EQ(simulate(c.task(), {current, speed, position, {}, {}, {}}), SimulationStatus::ok);
  for (std::size_t k = 1; k + 1 < n; ++k) {
    acceleration[k] = (speed[k + 1] - speed[k - 1]) / (2.0 * step);
    slope[k] = (current[k + 1] - current[k - 1]) / (2.0 * step);
  }
  std::vector<double> driven = c.input;  // held from row to row: at a row its mean of both sides acts
  for (std::size_t k = 1; k < n; ++k) driven[k] = 0.5 * (c.input[k] + c.input[k - 1]);
  Case along = c;
  along.input = driven;
  const bool winding = c.drive == drive_of("dc");
  unknown_inputs(along.task(),
                 {winding ? std::span<const double>(current) : std::span<const double>{},
                  winding ? std::span<const double>(slope) : std::span<const double>{}, speed, position, acceleration},
                 torque, winding ? std::span<double>(voltage) : std::span<double>{});
  double left = 0.0, size = 0.0, lost = 0.0, volts = 0.0;
  for (std::size_t k = 50; k + 1 < n; ++k) {
    if (std::abs(speed[k - 1]) < 1.0 || std::abs(speed[k + 1]) < 1.0) continue;
    const double driving = winding ? c.parameters[torque_constant] * current[k] : c.input[k];
    left += torque[k] * torque[k];
    size += driving * driving;
    lost += voltage[k] * voltage[k];
    volts += c.input[k] * c.input[k];
  }
  EXPECT_GT(size, 0.0);
  return {std::sqrt(left / size), std::sqrt(lost / volts)};
}

TEST(UnknownInputs, AreNoneAlongASimulatedAxis) { EXPECT_LT(left_over(Case("axis")).torque, 0.001); }

TEST(UnknownInputs, AreNoneAlongASimulatedMotor) {
  Case c("dc");
  c.add<BrushVoltageDrop>({1.0, 0.5});
  const Left left = left_over(c);
  EXPECT_LT(left.torque, 0.002);
  EXPECT_LT(left.voltage, 0.005);
}

TEST(UnknownInputs, AreWhatIsSwitchedOff) {
  Case c("dc");
  c.add<ConstantLoad>({0.05});
  const std::size_t n = 10;
  c.time.resize(n);
  c.input.assign(n, 0.0);
  const std::vector<double> still(n, 0.0);
  std::vector<double> torque(n), voltage(n);
  Case without = c;
  without.active.clear();
  unknown_inputs(c.task(), {still, still, still, still, still}, torque, voltage);
  EXPECT_NEAR(torque[5], 0.05, 1e-15);  // the load brakes, so that what is not known would have to drive
  unknown_inputs(without.task(), {still, still, still, still, still}, torque, voltage);
  EXPECT_EQ(torque[5], 0.0);
}

TEST(UnknownInputs, FollowTheMemoriesOfEffectsAndASecondMass) {
  Case bristles("axis");
  bristles.parameters[coulomb_friction] = 0.0;
  bristles.add<PreslidingHysteresis>({25.0, 0.01, 0.02});
  EXPECT_LT(left_over(bristles).torque, 0.005);
  Case shaft("axis");
  shaft.add<ShaftCompliance>({30.0, 5e-4, 1.2e-4, 0.4});
  EXPECT_LT(left_over(shaft).torque, 0.005);
}

TEST(UnknownInputs, ATransferFunctionHasNone) {
  Case c("lti");
  std::vector<double> any(c.time.size());
  EXPECT_THROW(unknown_inputs(c.task(), {{}, {}, any, any, any}, any, {}), std::invalid_argument);
}

}  // namespace
}  // namespace rwn
